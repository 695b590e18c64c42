# Compiles through ccache where it is installed, and finds again what another checkout compiled, with
# line tables too (their folder is then that of the first checkout; the lines are the same), and what
# includes a precompiled header. The compiler itself names what a file depends on (CCACHE_DEPEND):
# preprocessing each file first to find out would take a sixth of the time to compile it.
find_program(SOFTSCOPE_CCACHE ccache)
if(SOFTSCOPE_CCACHE)
  foreach(language CXX CUDA)
    if(NOT DEFINED CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
          CCACHE_SLOPPINESS=pch_defines,time_macros ${SOFTSCOPE_CCACHE})
    endif()
  endforeach()
endif()
