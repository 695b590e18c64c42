# One target per folder. Headers are included by their path from the source root:
#   src/core/camera.h is "core/camera.h", eval/motion/revisit.h is "eval/motion/revisit.h".
get_filename_component(SOFTSCOPE_ROOT ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
include(${CMAKE_CURRENT_LIST_DIR}/SoftscopeFlags.cmake)

# softscope_join(<target>): compiles up to 64 files at once, so that what they include is parsed, and
# templates are instantiated, once for all of them: sanitized, half the time of 16 files. Local names
# must then differ within a target; a clash is a compile error: give the later one a better name, or
# SKIP_UNITY_BUILD_INCLUSION where headers clash.
function(softscope_join target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD "${SOFTSCOPE_JOIN}"
    UNITY_BUILD_BATCH_SIZE 64)
endfunction()

# softscope_precompile(<target>): takes the headers of the standard library, of Eigen and of JSON from
# the target softscope_headers, which parses them once for all libraries that a shared library may
# hold; what tests alone run takes them and GoogleTest's from softscope_test_headers, if it is
# optimised alike. A folder that builds alone has neither.
function(softscope_precompile target)
  set(donor softscope_test_headers)
  get_target_property(position_independent ${target} POSITION_INDEPENDENT_CODE)
  get_target_property(quickly ${target} SOFTSCOPE_QUICKLY)
  if(position_independent)
    set(donor softscope_headers)
  elseif(SOFTSCOPE_SANITIZE AND NOT quickly)
    return()
  endif()
  if(NOT TARGET ${donor})
    return()
  endif()
  softscope_cache_precompiled(${target})
  target_precompile_headers(${target} REUSE_FROM ${donor})
endfunction()

# softscope_cache_precompiled(<target>): without these options ccache passes such files by.
function(softscope_cache_precompiled target)
  target_compile_options(${target} PRIVATE
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>"
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# softscope_precompiled_headers(<target> <header>…): a target that parses these headers, those of Eigen
# and of JSON, and instantiates what most files use of both.
function(softscope_precompiled_headers target)
  add_library(${target} OBJECT ${SOFTSCOPE_ROOT}/cmake/precompiled_headers.cpp)
  target_link_libraries(${target} PRIVATE softscope_flags Eigen3::Eigen nlohmann_json::nlohmann_json)
  softscope_cache_precompiled(${target})
  target_precompile_headers(${target} PRIVATE ${ARGN} <Eigen/Dense> <nlohmann/json.hpp>
    ${SOFTSCOPE_ROOT}/cmake/common_templates.h)
endfunction()

# softscope_library(<folder> SOURCES … [LINKS …] [PRIVATE_LINKS …])
function(softscope_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(softscope_${name} STATIC ${ARG_SOURCES})
  softscope_join(softscope_${name})
  add_library(softscope::${name} ALIAS softscope_${name})
  set_target_properties(softscope_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(softscope_${name} PUBLIC ${SOFTSCOPE_ROOT}/src ${SOFTSCOPE_ROOT})
  target_link_libraries(softscope_${name} PUBLIC ${ARG_LINKS}
    PRIVATE ${ARG_PRIVATE_LINKS} softscope_flags)
  softscope_precompile(softscope_${name})
endfunction()

# softscope_kernels(<folder> SOURCES … [OPTIONS …] [BASELINE …] [AVX2 …]): inner loops of this library,
# compiled once for every instruction set (core/kernel_list.h), with the options of all sets and those
# of one. No square root sets errno, or it would not be an instruction.
function(softscope_kernels name)
  cmake_parse_arguments(ARG "" "" "SOURCES;OPTIONS;BASELINE;AVX2" ${ARGN})
  set(sets BASELINE)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND sets AVX2)
    target_compile_definitions(softscope_${name} PRIVATE SOFTSCOPE_HAS_AVX2)
  endif()
  foreach(set IN LISTS sets)
    string(TOLOWER ${set} lower)
    set(target softscope_${name}_kernels_${lower})
    add_library(${target} OBJECT ${ARG_SOURCES})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target} PRIVATE ${SOFTSCOPE_ROOT}/src ${SOFTSCOPE_ROOT})
    target_compile_definitions(${target} PRIVATE SOFTSCOPE_SIMD_SET=${lower})
    target_compile_options(${target} PRIVATE -fno-math-errno -Wno-psabi ${ARG_OPTIONS} ${ARG_${set}})
    target_link_libraries(${target} PRIVATE softscope::core softscope_flags)
    target_sources(softscope_${name} PRIVATE $<TARGET_OBJECTS:${target}>)
  endforeach()
endfunction()

# softscope_inline(<folder>): for loops of many small Eigen operations. Sanitizers' checks make small
# functions too large for clang to inline by itself; inlined all the same, the tests of the simulator
# take less than half the time. Not for every folder: what includes JSON compiles 2 to 5 times as long.
function(softscope_inline name)
  if(SOFTSCOPE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(softscope_${name} PRIVATE "SHELL:-mllvm -inline-threshold=2000")
  endif()
endfunction()

# softscope_cover(<folder>): counts branches and comparisons, by which libFuzzer guides a fuzz target
# through the readers of this folder. Not for every folder: the tests of fusion took 1.75 times the
# processor time with it.
function(softscope_cover name)
  if(SOFTSCOPE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(softscope_${name} PRIVATE -fsanitize=fuzzer-no-link)
    set_target_properties(softscope_${name} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# softscope_test(<folder> SOURCES … LINKS … [SINGLY <suite>…] [SHARDS <count>] [COMPUTES]): one test
# program a folder, one ctest entry a test suite, or a test in the suites of SINGLY, which take minutes;
# under sanitizers, which start slowly, one entry a program, or as many as SHARDS says where one would
# keep the others waiting. COMPUTES: its own code takes long, unless it is optimised. Label: the folder.
function(softscope_test name)
  cmake_parse_arguments(ARG "COMPUTES" "SHARDS" "SOURCES;LINKS;SINGLY" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  softscope_join(test_${name})
  if(NOT ARG_COMPUTES OR NOT SOFTSCOPE_SANITIZE)
    softscope_compile_quickly(test_${name})
  endif()
  softscope_precompile(test_${name})
  target_link_libraries(test_${name} PRIVATE ${ARG_LINKS} GTest::gtest_main softscope_flags)
  target_include_directories(test_${name} PRIVATE ${SOFTSCOPE_ROOT}/tests)
  softscope_link_optimised_first(test_${name})
  if(SOFTSCOPE_SANITIZE)
    softscope_test_shards(${name} ${ARG_SHARDS})
    if(ARG_COMPUTES)
      set_tests_properties(${name} PROPERTIES COST 15)
    endif()
  else()
    softscope_test_suites(${name} ${ARG_SINGLY})
  endif()
endfunction()

# softscope_test_suites(<folder> [suite…]): the program itself tells its suites once it is linked.
function(softscope_test_suites name)
  set(entries ${CMAKE_CURRENT_BINARY_DIR}/test_${name}_suites.cmake)
  add_custom_command(TARGET test_${name} POST_BUILD BYPRODUCTS ${entries}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:test_${name}> -D FOLDER=${name}
      -D "SINGLY=${ARGN}" -D FILE=${entries}
      -P ${SOFTSCOPE_ROOT}/cmake/SoftscopeSuites.cmake VERBATIM)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/test_${name}_include.cmake @ONLY CONTENT
    "if(EXISTS \"${entries}\")
  include(\"${entries}\")
else()
  add_test(test_${name}_is_not_built test_${name}_is_not_built)
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES
    ${CMAKE_CURRENT_BINARY_DIR}/test_${name}_include.cmake)
endfunction()

# softscope_compile_quickly(<target>): for code without inner loops (texts, JSON, command lines) and for
# tests: -O1 and little inlining, a third less time to compile; under sanitizers -O0, half to a quarter
# of the time. Not for libraries that compute or draw: a page of a report took 5 % more instructions.
function(softscope_compile_quickly target)
  set_target_properties(${target} PROPERTIES SOFTSCOPE_QUICKLY ON)
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O1>
    "$<$<AND:$<CONFIG:Release>,$<COMPILE_LANG_AND_ID:CXX,Clang>>:SHELL:-mllvm -inline-threshold=25>")
  if(SOFTSCOPE_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
    get_target_property(position_independent ${target} POSITION_INDEPENDENT_CODE)
    if(position_independent)  # whose precompiled headers are of optimised code
      set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    endif()
  endif()
endfunction()

# softscope_link_optimised_first(<program>): the linker takes inline functions from the first object
# that has them. Were those of -O0 first, tests of deform would take 12 times as long under sanitizers.
function(softscope_link_optimised_first target)
  if(SOFTSCOPE_SANITIZE)
    softscope_linked_libraries(${target} libraries)
    list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>")
    target_link_options(${target} PRIVATE
      "LINKER:--push-state,--whole-archive" ${libraries} "LINKER:--pop-state")
  endif()
endfunction()

# softscope_linked_libraries(<target> <list>): appends what it links of ours, optimised, once each.
function(softscope_linked_libraries target list)
  get_target_property(links ${target} LINK_LIBRARIES)
  foreach(link IN LISTS links)
    if(link MATCHES "^softscope(_|::)" AND TARGET ${link})
      get_target_property(type ${link} TYPE)
      get_target_property(name ${link} ALIASED_TARGET)
      if(NOT name)
        set(name ${link})
      endif()
      get_target_property(quickly ${link} SOFTSCOPE_QUICKLY)
      if(type STREQUAL "STATIC_LIBRARY" AND NOT name IN_LIST ${list})
        if(NOT quickly)
          list(APPEND ${list} ${name})
        endif()
        softscope_linked_libraries(${name} ${list})
      endif()
    endif()
  endforeach()
  set(${list} ${${list}} PARENT_SCOPE)
endfunction()

# softscope_test_shards(<folder> [count]): programs in several parts take longest and start first,
# then those that compute.
function(softscope_test_shards name)
  set(count 1)
  if(ARGC GREATER 1)
    set(count ${ARGV1})
  endif()
  foreach(number RANGE 1 ${count})
    set(entry ${name})
    if(count GREATER 1)
      set(entry ${name}.${number})
    endif()
    math(EXPR index "${number} - 1")
    add_test(NAME ${entry} COMMAND test_${name})
    set_tests_properties(${entry} PROPERTIES TIMEOUT 1200 LABELS ${name} COST ${count}0
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# softscope_fuzz(<reader> SOURCES … LINKS … CORPUS <folder> [RUNS <count>]): a reader that must
# answer any bytes with a value or an InputError. SOURCES define LLVMFuzzerTestOneInput. With clang
# and sanitizers, libFuzzer mutates the corpus, guided by coverage; any other build damages it
# blindly. Both for a bounded count, from a fixed seed, and the corpus stays as it is.
function(softscope_fuzz name)
  cmake_parse_arguments(ARG "" "CORPUS;RUNS" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_RUNS)
    set(ARG_RUNS 5000)
  endif()
  get_filename_component(corpus ${ARG_CORPUS} ABSOLUTE)
  add_executable(fuzz_${name} ${ARG_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE ${ARG_LINKS} softscope_flags)
  target_include_directories(fuzz_${name} PRIVATE ${SOFTSCOPE_ROOT}/tests)
  if(SOFTSCOPE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(fuzz_${name} PRIVATE -fsanitize=fuzzer-no-link)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    softscope_fuzz_seeds(${corpus} ${CMAKE_CURRENT_BINARY_DIR}/${name}_seeds.txt)
    add_test(NAME fuzz.${name} COMMAND fuzz_${name} -runs=${ARG_RUNS} -seed=1 -timeout=20
      -rss_limit_mb=4096 -seed_inputs=@${CMAKE_CURRENT_BINARY_DIR}/${name}_seeds.txt)
  else()
    if(NOT TARGET softscope_replay_corpus)
      add_library(softscope_replay_corpus OBJECT ${SOFTSCOPE_ROOT}/tests/support/replay_corpus.cpp)
      target_link_libraries(softscope_replay_corpus PRIVATE softscope_flags)
    endif()
    target_link_libraries(fuzz_${name} PRIVATE softscope_replay_corpus)
    softscope_precompile(fuzz_${name})
    add_test(NAME fuzz.${name} COMMAND fuzz_${name} ${corpus})
  endif()
  set_tests_properties(fuzz.${name} PROPERTIES TIMEOUT 600 LABELS fuzz)
endfunction()

# libFuzzer would write into a corpus folder; a list of its files it only reads.
function(softscope_fuzz_seeds corpus list)
  file(GLOB_RECURSE seeds CONFIGURE_DEPENDS ${corpus}/*)
  list(JOIN seeds "," seeds)
  file(WRITE ${list} "${seeds}")
endfunction()
