# The packages that `make package` makes: a .deb, and a tarball that runs from any folder.

# The program finds the tarball's libraries from its own place. RPATH and not RUNPATH, since the dynamic linker searches
# RPATH for the libraries of libraries too.
file(RELATIVE_PATH from_program /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR}/isojam)
set_target_properties(isojam PROPERTIES INSTALL_RPATH "$ORIGIN/${from_program}")
target_link_options(isojam PRIVATE -Wl,--disable-new-dtags)

# In the tarball alone: libraries that another system lacks or has in another version. The C and C++ libraries are those of
# the system, since newer ones run programs that were built with older ones.
set(in_tarball COMPONENT tarball EXCLUDE_FROM_ALL)
set(libraries libmetis.so.5 libtbb.so.12)
set(dependencies libmetis5 libtbb12)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
else()
  list(APPEND libraries libquadmath.so.0)
  list(APPEND dependencies libquadmath0)
endif()
foreach(library ${libraries})
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} --sysroot=${CMAKE_SYSROOT} -print-file-name=${library}
                  OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH ${path} path)
  install(FILES ${path} RENAME ${library} DESTINATION ${CMAKE_INSTALL_LIBDIR}/isojam ${in_tarball})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} ${in_tarball})

# The licences of all that is compiled or copied into either.
foreach(package ${dependencies} libeigen3-dev libspectra-dev nlohmann-json3-dev libfmt-dev libcli11-dev libboost-dev
                libjs-vega libjs-three)
  file(REAL_PATH ${CMAKE_SYSROOT}/usr/share/doc/${package}/copyright licence)
  install(FILES ${licence} DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences RENAME ${package} OPTIONAL)
endforeach()

# In the .deb alone.
set(debian ${CMAKE_CURRENT_LIST_DIR}/debian)
set(in_deb COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${debian}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} ${in_deb})
install(FILES ${debian}/changelog RENAME changelog.Debian DESTINATION ${CMAKE_INSTALL_DOCDIR} ${in_deb})
install(SCRIPT ${debian}/layout.cmake ${in_deb})

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/cpack.cmake)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGE_VENDOR "the isojam developers")
set(CPACK_PACKAGE_FILE_NAME isojam-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The isojam developers <isojam@example.org>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# By hand, because dpkg-shlibdeps does not look into the root of another architecture.
string(REGEX MATCH "^[0-9]+" compiler ${CMAKE_CXX_COMPILER_VERSION})
file(STRINGS ${CMAKE_SYSROOT}/usr/include/features.h glibc REGEX "define.__GLIBC_MINOR__")
string(REGEX REPLACE "[^0-9]" "" glibc "${glibc}")
list(APPEND dependencies "libc6 (>= 2.${glibc})" libgcc-s1 "libstdc++6 (>= ${compiler})" python3:any)
list(JOIN dependencies ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-pandas)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, libmetis-dev, libtbb-dev, python3-matplotlib, python3-tqdm")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "jammed packings of soft frictionless convex solids
isojam makes jammed packings of soft, frictionless convex solids, Platonic
ones above all, in a periodic cell. It measures the jamming density, the
contact number and the constraint number, each with a confidence interval
over independent replicates, and asks why a packing is rigid.
.
This package has the program, a Python module that runs it and reads results,
and the headers and library of the engine for C++ programs (with
libeigen3-dev, libmetis-dev and libtbb-dev).")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${debian}/postinst ${debian}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
