# softscope_embed(<target> <name> FILES …): texts of the tree inside the program. Writes <name>.cpp into
# the build folder: `const char* const <name>_<file>_<extension>` in namespace softscope::embedded, one
# a file, and compiles it into the target. A changed file is embedded anew.
function(softscope_embed target name)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(code "// The texts of ${name}, as they stand in the tree.\nnamespace softscope::embedded {\n")
  foreach(file ${ARG_FILES})
    get_filename_component(path ${file} ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
    get_filename_component(stem ${file} NAME)
    string(MAKE_C_IDENTIFIER ${stem} stem)
    file(READ ${path} text)
    string(APPEND code "extern const char* const ${name}_${stem};\n"
      "const char* const ${name}_${stem} = R\"softscope_text(${text})softscope_text\";\n")
  endforeach()
  string(APPEND code "}  // namespace softscope::embedded\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "@code@" @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
endfunction()
