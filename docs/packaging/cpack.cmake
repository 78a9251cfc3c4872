# CPack reads this once for each package: what all packages have comes first, then what this one has.
list(GET CPACK_INSTALL_CMAKE_PROJECTS 0 build)
if(CPACK_GENERATOR STREQUAL "DEB")
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${build};isojam;debian;/")
else()
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${build};isojam;tarball;/")
endif()
