# embed_parts(<list> <name> <part>...): generates a source that contains the files of the parts as bytes and returns
# them from isojam::<name>(). Its path is appended to the variable <list>. A part is "kind|name|file", with kinds as in
# parts.hpp.
set(embed_parts_template ${CMAKE_CURRENT_LIST_DIR}/parts.cpp.in)

function(embed_parts list_variable name)
  set(symbols "")
  set(entries "")
  set(files "")
  set(index 0)
  foreach(part IN LISTS ARGN)
    string(REPLACE "|" ";" fields "${part}")
    list(GET fields 0 kind)
    list(GET fields 1 part_name)
    list(GET fields 2 file)
    if(NOT EXISTS "${file}")
      message(FATAL_ERROR "${file} is missing. Pages embed Vega and three.js: "
                          "apt-get install libjs-vega libjs-three, or set ISOJAM_JAVASCRIPT")
    endif()
    list(APPEND files "${file}")
    set(symbol "isojam_${name}_${index}")
    string(APPEND symbols "asm(\".section .rodata\\n${symbol}: .incbin \\\"${file}\\\"\\n"
                          "${symbol}_end: .byte 0\\n.previous\\n\");\n"
                          "extern \"C\" const char ${symbol}[], ${symbol}_end[];\n")
    string(APPEND entries "      PagePart{PagePart::Kind::${kind}, \"${part_name}\", between(${symbol}, "
                          "${symbol}_end)},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  configure_file(${embed_parts_template} ${source} @ONLY)
  # In a batch of sources, the dependence on the files would be lost.
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}" SKIP_UNITY_BUILD_INCLUSION ON)
  set(${list_variable} ${${list_variable}} ${source} PARENT_SCOPE)
endfunction()
