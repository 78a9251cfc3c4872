# The tests of the engine need GoogleTest alone. Every other layer of tests is built where the packages that it needs are
# found; isojam_report_layers() names those that are not built.

# Columns as in engine/packages.cmake.
list(APPEND isojam_package_names
  Python         python3               python3            python              python
  numpy          python3-numpy         python3-numpy      python-numpy        numpy
  pandas         python3-pandas        python3-pandas     python-pandas       pandas
  matplotlib     python3-matplotlib    python3-matplotlib python-matplotlib   matplotlib
  scipy          python3-scipy         python3-scipy      python-scipy        scipy
  gsd            python3-gsd           gsd                python-gsd          gsd
  vtkmodules     python3-vtk9          python3-vtk        vtk                 vtk
  yaml           python3-yaml          python3-pyyaml     python-yaml         pyyaml
  selenium       python3-selenium      python3-selenium   python-selenium     selenium
  chromium       chromium              chromium           chromium            chromium
  chromedriver   chromium-driver       chromedriver       chromium            chromedriver-binary
  mkdocs         mkdocs                mkdocs             mkdocs              mkdocs
  vega           libjs-vega            vega               vega                vega
  three          libjs-three           three              three               three)

# isojam_layer(<out> <what is tested> <package>...): ON if found_<package> is true for all packages.
function(isojam_layer out tested)
  set(missing "")
  foreach(package IN LISTS ARGN)
    if(NOT found_${package})
      isojam_package_name(name ${package})
      list(APPEND missing ${name})
    endif()
  endforeach()
  set(${out} ON PARENT_SCOPE)
  if(missing)
    set(${out} OFF PARENT_SCOPE)
    list(JOIN missing ", " names)
    set_property(GLOBAL APPEND PROPERTY ISOJAM_UNTESTED "${tested}: ${names}")
    set_property(GLOBAL APPEND PROPERTY ISOJAM_UNTESTED_PACKAGES ${missing})
  endif()
endfunction()

# isojam_add_layer(<folder> <what is tested> <package>...): adds the folder if all packages were found.
function(isojam_add_layer folder tested)
  isojam_layer(built "${tested}" ${ARGN})
  if(built)
    add_subdirectory(${folder})
  endif()
endfunction()

function(isojam_report_layers)
  get_property(untested GLOBAL PROPERTY ISOJAM_UNTESTED)
  get_property(packages GLOBAL PROPERTY ISOJAM_UNTESTED_PACKAGES)
  if(NOT untested)
    message(STATUS "All tests are built")
    return()
  endif()
  list(JOIN untested "\n  " lines)
  list(REMOVE_DUPLICATES packages)
  list(JOIN packages " " names)
  isojam_distribution(column command)
  if(NOT command)
    set(command "install")
  endif()
  message(NOTICE "Tests that are not built, and the packages that they need:\n  ${lines}\n"
                 "To build them: ${command} ${names}, then configure again.")
endfunction()

# ---- Search --------------------------------------------------------------------------------------------------
find_package(valijson QUIET)
foreach(program chromium chromedriver mkdocs)
  find_program(ISOJAM_TESTS_${program} ${program})
  set(found_${program} ${ISOJAM_TESTS_${program}})
endforeach()
set(found_valijson ${valijson_FOUND})
set(found_vega ${ISOJAM_PAGES})
set(found_three ${ISOJAM_PAGES})
set(found_Python ${ISOJAM_PYTHON})
if(ISOJAM_PYTHON)
  # As the tests run it: without PYTHONPATH and without the user's packages.
  execute_process(COMMAND ${ISOJAM_PYTHON} -E -s -c "
import importlib.util, sys
print(*filter(importlib.util.find_spec, sys.argv[1:]), sep=';', end='')"
                  numpy scipy pandas matplotlib gsd vtkmodules yaml selenium OUTPUT_VARIABLE modules)
  foreach(module IN LISTS modules)
    set(found_${module} ON)
  endforeach()
endif()
mark_as_advanced(ISOJAM_TESTS_chromium ISOJAM_TESTS_chromedriver ISOJAM_TESTS_mkdocs)
