# The packages that isojam needs, the minimum version of each, and its name in the distributions of docs/install.md.
# isojam_require() collects what is missing, isojam_report_missing() then names all of it in one message.

# Columns: name for CMake, Debian and Ubuntu, Fedora and Rocky (EPEL), Arch, conda-forge.
set(isojam_package_names
  TBB            libtbb-dev            tbb-devel        onetbb            tbb-devel
  Eigen3         libeigen3-dev         eigen3-devel     eigen             eigen
  Spectra        libspectra-dev        spectra-devel    spectra           spectra-cpp
  METIS          libmetis-dev          metis-devel      metis             metis
  Boost          libboost-dev          boost-devel      boost             libboost-headers
  nlohmann_json  nlohmann-json3-dev    json-devel       nlohmann-json     nlohmann_json
  fmt            libfmt-dev            fmt-devel        fmt               fmt
  CLI11          libcli11-dev          cli11-devel      cli11             cli11
  GTest          libgtest-dev          gtest-devel      gtest             gtest
  valijson       libvalijson-dev       valijson-devel   valijson          valijson)

# isojam_distribution(<out column> <out command>): column of isojam_package_names for this machine, and the command that
# installs packages; column 0 where the distribution is unknown.
function(isojam_distribution column command)
  cmake_host_system_information(RESULT id QUERY DISTRIB_ID)
  cmake_host_system_information(RESULT like QUERY DISTRIB_ID_LIKE)
  set(found 0)
  set(install "")
  if(DEFINED ENV{CONDA_PREFIX})
    set(found 4)
    set(install "conda install -c conda-forge")
  elseif("${id} ${like}" MATCHES "debian|ubuntu")
    set(found 1)
    set(install "apt-get install")
  elseif("${id} ${like}" MATCHES "fedora|rhel|rocky")
    set(found 2)
    set(install "dnf install")
  elseif("${id} ${like}" MATCHES "arch")
    set(found 3)
    set(install "pacman -S")
  endif()
  set(${column} ${found} PARENT_SCOPE)
  set(${command} "${install}" PARENT_SCOPE)
endfunction()

# isojam_package_name(<out> <name for CMake>): the package's name on this machine, or the name for CMake.
function(isojam_package_name out package)
  isojam_distribution(column command)
  list(FIND isojam_package_names ${package} place)
  if(place GREATER_EQUAL 0)
    math(EXPR place "${place} + ${column}")
    list(GET isojam_package_names ${place} name)
  else()
    set(name ${package})
  endif()
  set(${out} ${name} PARENT_SCOPE)
endfunction()

# isojam_miss(<package> <minimum> <purpose> <what was found>): notes that a package is missing or too old.
function(isojam_miss package minimum purpose found)
  isojam_package_name(name ${package})
  set_property(GLOBAL APPEND_STRING PROPERTY ISOJAM_MISSING "\n  ${package} ${minimum} or newer (${purpose}): ${found}")
  set_property(GLOBAL APPEND PROPERTY ISOJAM_MISSING_PACKAGES ${name})
endfunction()

# isojam_require(<package> <minimum> <purpose> <option of find_package>...). The version is compared here: a package of a
# newer major version passes too, which find_package(<package> <version>) may refuse.
macro(isojam_require package minimum purpose)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    isojam_miss(${package} ${minimum} "${purpose}" "not found")
  elseif(${package}_VERSION AND ${package}_VERSION VERSION_LESS ${minimum})
    isojam_miss(${package} ${minimum} "${purpose}" "version ${${package}_VERSION} is too old")
  else()
    message(STATUS "${package} ${${package}_VERSION}")
  endif()
endmacro()

# METIS describes itself neither to CMake nor to pkg-config. An installed engine reads this file too.
function(isojam_find_metis)
  if(TARGET isojam::metis)
    return()
  endif()
  find_path(ISOJAM_METIS_INCLUDE metis.h)
  find_library(ISOJAM_METIS_LIBRARY metis)
  mark_as_advanced(ISOJAM_METIS_INCLUDE ISOJAM_METIS_LIBRARY)
  if(ISOJAM_METIS_INCLUDE AND ISOJAM_METIS_LIBRARY)
    add_library(isojam::metis UNKNOWN IMPORTED GLOBAL)
    set_target_properties(isojam::metis PROPERTIES IMPORTED_LOCATION "${ISOJAM_METIS_LIBRARY}"
                                                   INTERFACE_INCLUDE_DIRECTORIES "${ISOJAM_METIS_INCLUDE}")
  else()
    isojam_miss(METIS 5.1 "order of elimination" "metis.h or the library was not found")
  endif()
endfunction()

# isojam_missing_message(<out>): all that is missing and how to install it; empty if nothing is.
function(isojam_missing_message out)
  get_property(missing GLOBAL PROPERTY ISOJAM_MISSING)
  get_property(packages GLOBAL PROPERTY ISOJAM_MISSING_PACKAGES)
  set(text "")
  if(missing)
    isojam_distribution(column command)
    list(JOIN packages " " names)
    if(column)
      set(remedy "Install: ${command} ${names}")
    else()
      set(remedy "This distribution is not in docs/install.md; the packages have similar names there: ${names}")
    endif()
    set(text "isojam needs packages that are missing or too old.${missing}\n${remedy}\n"
             "If a package is installed elsewhere, add -DCMAKE_PREFIX_PATH=ITS_PREFIX.")
    string(CONCAT text ${text})
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

function(isojam_report_missing)
  isojam_missing_message(text)
  if(text)
    message(FATAL_ERROR "${text}")
  endif()
endfunction()
