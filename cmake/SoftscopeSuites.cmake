# cmake -D PROGRAM=… -D FOLDER=… -D SINGLY=… -D FILE=… -P: ctest entries of a test program.
# One entry for each test suite, as most programs load for longer than one test takes. Suites of
# SINGLY take minutes: each of their tests is an entry of its own and starts first.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE lines RESULT_VARIABLE status TIMEOUT 60)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${status}, but 0 was expected.\n${lines}")
endif()

set(entries "")
function(add_entry name filter properties)
  string(APPEND entries "add_test([==[${FOLDER}.${name}]==] [==[${PROGRAM}]==] "
    "[==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${FOLDER}.${name}]==] PROPERTIES TIMEOUT 600 LABELS ${FOLDER}"
    "${properties})\n")
  set(entries "${entries}" PARENT_SCOPE)
endfunction()

string(REGEX REPLACE " +#[^\n]*" "" lines "${lines}")  # values of parameters
string(REPLACE "\n" ";" lines "${lines}")
foreach(line IN LISTS lines)
  if(line MATCHES "^  (.+)$")
    if(suite IN_LIST SINGLY)
      add_entry("${suite}.${CMAKE_MATCH_1}" "${suite}.${CMAKE_MATCH_1}" " COST 10")
    endif()
  elseif(line MATCHES "^(.+)\\.$")
    set(suite "${CMAKE_MATCH_1}")
    if(NOT suite IN_LIST SINGLY)
      add_entry("${suite}" "${suite}.*" "")
    endif()
  endif()
endforeach()
file(WRITE ${FILE} "${entries}")
