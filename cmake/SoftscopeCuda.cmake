# Looks for a CUDA compiler, also off PATH, and sets SOFTSCOPE_HAS_CUDA. Where none works, AUTO
# builds for the CPU alone, and ON is an error.
set(SOFTSCOPE_CUDA AUTO CACHE STRING "Build the CUDA back end: ON, OFF, or AUTO, where nvcc is found")
set_property(CACHE SOFTSCOPE_CUDA PROPERTY STRINGS AUTO ON OFF)

set(SOFTSCOPE_HAS_CUDA OFF)
if(NOT SOFTSCOPE_CUDA)
  return()
endif()
if(NOT CMAKE_CUDA_COMPILER)
  unset(CMAKE_CUDA_COMPILER CACHE)  # a toolkit may have come since the last configure
  if(NOT DEFINED ENV{CUDACXX})
    find_program(SOFTSCOPE_NVCC nvcc NO_CACHE
      HINTS ENV CUDA_PATH ENV CUDA_HOME ${CUDAToolkit_ROOT}
      PATHS /usr/local/cuda PATH_SUFFIXES bin)
    if(SOFTSCOPE_NVCC)
      set(ENV{CUDACXX} ${SOFTSCOPE_NVCC})
    endif()
  endif()
endif()
include(CheckLanguage)
check_language(CUDA)  # compiles with it: a broken nvcc is NOTFOUND

if(CMAKE_CUDA_COMPILER)
  execute_process(COMMAND ${CMAKE_CUDA_COMPILER} --version OUTPUT_VARIABLE softscope_nvcc_says)
  string(REGEX MATCH "release ([0-9.]+)" _ "${softscope_nvcc_says}")
  set(SOFTSCOPE_CUDA_VERSION ${CMAKE_MATCH_1})
endif()

if(NOT CMAKE_CUDA_COMPILER)
  set(softscope_no_cuda "no working nvcc was found")
elseif(SOFTSCOPE_CUDA_VERSION VERSION_LESS 12)
  set(softscope_no_cuda
    "${CMAKE_CUDA_COMPILER} is CUDA ${SOFTSCOPE_CUDA_VERSION}, but 12 or newer is needed")
else()
  # Machine code for each generation from Turing on, so that no GPU waits for its driver to
  # translate; the PTX of 90 serves those that come later. CMake takes others from CUDAARCHS.
  if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
    set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 90)
    if(SOFTSCOPE_CUDA_VERSION VERSION_GREATER_EQUAL 12.8)
      list(APPEND CMAKE_CUDA_ARCHITECTURES 100-real 120-real)
    endif()
  endif()
  enable_language(CUDA)
  set(CMAKE_CUDA_STANDARD 17)
  set(CMAKE_CUDA_STANDARD_REQUIRED ON)
  find_package(CUDAToolkit REQUIRED)
  set(SOFTSCOPE_HAS_CUDA ON)
  message(STATUS "softscope: CUDA ${SOFTSCOPE_CUDA_VERSION} for ${CMAKE_CUDA_ARCHITECTURES}")
endif()

if(NOT SOFTSCOPE_HAS_CUDA)
  if(NOT SOFTSCOPE_CUDA STREQUAL "AUTO")
    message(FATAL_ERROR "softscope: ${softscope_no_cuda}. Install a CUDA 12 or 13 toolkit, name its "
      "compiler in the environment variable CUDACXX, or build with -DSOFTSCOPE_CUDA=AUTO.")
  endif()
  message(STATUS "softscope: CPU only, ${softscope_no_cuda}")
endif()
