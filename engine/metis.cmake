# Debian's METIS says neither to CMake nor to pkg-config where it is. Read here, and by who links an installed engine.
if(NOT TARGET isojam::metis)
  find_path(ISOJAM_METIS_INCLUDE metis.h)
  find_library(ISOJAM_METIS_LIBRARY metis)
  mark_as_advanced(ISOJAM_METIS_INCLUDE ISOJAM_METIS_LIBRARY)
  if(ISOJAM_METIS_INCLUDE AND ISOJAM_METIS_LIBRARY)
    add_library(isojam::metis UNKNOWN IMPORTED GLOBAL)
    set_target_properties(isojam::metis PROPERTIES IMPORTED_LOCATION "${ISOJAM_METIS_LIBRARY}"
                                                   INTERFACE_INCLUDE_DIRECTORIES "${ISOJAM_METIS_INCLUDE}")
  elseif(NOT CMAKE_FIND_PACKAGE_NAME)
    message(FATAL_ERROR "METIS 5.1 is needed and not here: its package is libmetis-dev")
  endif()
endif()
