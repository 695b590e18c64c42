# Compiles through ccache where it is installed, and finds again what another checkout compiled, with
# line tables too (their folder is then that of the first checkout; the lines are the same), and what
# includes a precompiled header.
find_program(SOFTSCOPE_CCACHE ccache)
if(SOFTSCOPE_CCACHE)
  foreach(language CXX CUDA)
    if(NOT DEFINED CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
          CCACHE_SLOPPINESS=pch_defines,time_macros ${SOFTSCOPE_CCACHE})
    endif()
  endforeach()
endif()
