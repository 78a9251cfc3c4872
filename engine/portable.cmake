# The engine as a shared library in two variants: for every x86-64, and for x86-64-v3, which has AVX2 and FMA. Where the
# processor has x86-64-v3, the dynamic linker finds the second variant first, in glibc-hwcaps/x86-64-v3 beside the other
# (glibc 2.33 and newer). Both have one set of headers, so no type in a header may depend on the instructions there are.

get_target_property(sources isojam_engine SOURCES)
add_library(isojam_engine_v3 SHARED ${sources})
foreach(property LINK_LIBRARIES INCLUDE_DIRECTORIES COMPILE_FEATURES COMPILE_OPTIONS COMPILE_DEFINITIONS
                 PRECOMPILE_HEADERS)
  get_target_property(value isojam_engine ${property})
  if(value)
    set_target_properties(isojam_engine_v3 PROPERTIES ${property} "${value}")
  endif()
endforeach()
target_compile_options(isojam_engine_v3 PRIVATE -march=x86-64-v3)
set_target_properties(isojam_engine_v3 PROPERTIES
                      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/glibc-hwcaps/x86-64-v3)

# Each variant calls its own copies of inline functions and templates, never those of the program, which use no AVX2.
foreach(engine isojam_engine isojam_engine_v3)
  set_target_properties(${engine} PROPERTIES OUTPUT_NAME isojam_engine
                        SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_options(${engine} PRIVATE -fno-semantic-interposition)
  target_link_options(${engine} PRIVATE -Wl,-Bsymbolic-functions)
endforeach()
add_dependencies(isojam_engine isojam_engine_v3)

if(ISOJAM_INSTALL)
  install(TARGETS isojam_engine_v3 LIBRARY NAMELINK_SKIP
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/isojam/glibc-hwcaps/x86-64-v3)
endif()
