# `cmake --build build/release --target tidy` runs clang-tidy over all sources, where it is there.
find_program(SOFTSCOPE_RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
if(SOFTSCOPE_RUN_CLANG_TIDY)
  add_custom_target(tidy
    COMMAND ${SOFTSCOPE_RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR}
      "${CMAKE_SOURCE_DIR}/(src|eval|vtk_views|toolkit|apps|packaging|tests)/.*[.]cpp"
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
    USES_TERMINAL VERBATIM)
endif()
