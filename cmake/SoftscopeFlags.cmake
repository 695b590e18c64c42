# How every target of softscope is compiled: warnings are errors; Release is -O3 for any x86-64
# (folders with hot loops compile those once more for newer processors and choose at run time).
add_library(softscope_flags INTERFACE)
target_compile_options(softscope_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Werror>
  # 20012: Eigen marks defaulted functions for the device, which nvcc ignores aloud.
  "$<$<COMPILE_LANGUAGE:CUDA>:SHELL:-Werror all-warnings -Xcompiler=-Wall,-Wextra,-Wshadow,-Werror \
--expt-relaxed-constexpr --diag-suppress=20012>")

# vptr is left out: it wants type information that VTK and OpenCV keep to themselves. Assertions of
# Eigen and the standard library are on, and Eigen's unset numbers are NaN; UBSan passes by their
# headers.
if(SOFTSCOPE_SANITIZE)
  set(softscope_sanitizers -fsanitize=address,undefined -fno-sanitize=vptr)
  target_compile_options(softscope_flags INTERFACE
    ${softscope_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/library_headers.txt>)
  target_compile_definitions(softscope_flags INTERFACE
    _GLIBCXX_ASSERTIONS EIGEN_INITIALIZE_MATRICES_BY_NAN)
  target_link_options(softscope_flags INTERFACE ${softscope_sanitizers})
  find_program(SOFTSCOPE_SYMBOLIZER NAMES llvm-symbolizer llvm-symbolizer-14)
  if(NOT SOFTSCOPE_SYMBOLIZER)
    message(STATUS "softscope: no llvm-symbolizer; what sanitizers find has addresses and no names")
    target_compile_definitions(softscope_flags INTERFACE SOFTSCOPE_NO_SYMBOLIZER)
  endif()
  target_sources(softscope_flags INTERFACE
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${CMAKE_CURRENT_LIST_DIR}/sanitizer_defaults.cpp>)
endif()

# gold, where it is installed, links a test program in a third of the processor time of GNU ld.
if(NOT SOFTSCOPE_SANITIZE AND NOT CMAKE_EXE_LINKER_FLAGS MATCHES "-fuse-ld")
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold SOFTSCOPE_HAS_GOLD)
  if(SOFTSCOPE_HAS_GOLD)
    target_link_options(softscope_flags INTERFACE -fuse-ld=gold)
  endif()
endif()
