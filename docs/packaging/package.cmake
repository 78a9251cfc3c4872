# The packages that `make package` makes of a portable build: a .deb, and a tarball that runs from any folder.

# The program finds the engine, and the tarball's libraries, from its own place. RPATH and not RUNPATH, since the dynamic
# linker searches RPATH for the libraries of libraries too.
file(RELATIVE_PATH from_program /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${CMAKE_INSTALL_LIBDIR}/isojam)
set_target_properties(isojam PROPERTIES INSTALL_RPATH "$ORIGIN/${from_program}")
target_link_options(isojam PRIVATE -Wl,--disable-new-dtags)

# In the tarball alone: libraries that another system lacks or has in another version. The C and C++ libraries are those of
# the system, since newer ones run programs that were built with older ones.
set(in_tarball COMPONENT tarball EXCLUDE_FROM_ALL)
install(TARGETS isojam isojam_engine RUNTIME_DEPENDENCY_SET libraries
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} ${in_tarball}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/isojam ${in_tarball})
install(RUNTIME_DEPENDENCY_SET libraries
        PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|gcc_s|stdc\\+\\+|isojam_engine)\\.so"
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/isojam ${in_tarball})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} ${in_tarball})

# The licences of all that is compiled or copied into either.
foreach(package libtbb12 libmetis5 libquadmath0 libeigen3-dev libspectra-dev nlohmann-json3-dev libfmt-dev libcli11-dev
                libboost-dev libjs-vega libjs-three)
  file(REAL_PATH /usr/share/doc/${package}/copyright licence)
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
set(CPACK_PACKAGE_FILE_NAME isojam-${PROJECT_VERSION}-linux-x86_64)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The isojam developers <isojam@example.org>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/engine)
set(CPACK_DEBIAN_PACKAGE_DEPENDS python3:any)
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
