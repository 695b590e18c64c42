# Installs the library into a new folder, builds a project that finds it there, and runs that.
#   cmake -DBUILD=… -DPROJECT=… -DWORK=… -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  message(STATUS "${text}")
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} ended with ${code}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(component library development)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed --component ${component})
endforeach()
# Headers of other libraries, and of the source tree, must not be needed.
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/installed)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer ${WORK})
