# One target per folder. Headers are included by their path from the source root:
#   src/core/camera.h is "core/camera.h", eval/statistics.h is "eval/statistics.h".

add_library(softscope_flags INTERFACE)
target_compile_options(softscope_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Werror>)
if(SOFTSCOPE_SANITIZE)
  target_compile_options(softscope_flags INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer>)
  target_link_options(softscope_flags INTERFACE -fsanitize=address,undefined)
endif()

# softscope_library(<folder> SOURCES … [LINKS …] [PRIVATE_LINKS …])
function(softscope_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(softscope_${name} STATIC ${ARG_SOURCES})
  add_library(softscope::${name} ALIAS softscope_${name})
  set_target_properties(softscope_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(softscope_${name} PUBLIC
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(softscope_${name} PUBLIC ${ARG_LINKS}
    PRIVATE ${ARG_PRIVATE_LINKS} softscope_flags)
endfunction()

# softscope_test(<folder> SOURCES … LINKS …): one test program a folder, one ctest entry a test.
function(softscope_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_LINKS} GTest::gtest_main softscope_flags)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600)
endfunction()
