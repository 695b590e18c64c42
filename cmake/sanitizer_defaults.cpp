// cmake/sanitizer_defaults.cpp: how sanitized programs run unless the environment says otherwise.

// LeakSanitizer asks llvm-symbolizer for the names of every frame before it compares one with the
// suppressions below, though those name libraries and need no symbols; where there is no symbolizer
// it complains on stderr, in programs that lost nothing. An empty path leaves the question out.
#ifdef SOFTSCOPE_NO_SYMBOLIZER
#define SOFTSCOPE_SYMBOLIZER_OPTION ":external_symbolizer_path="
#else
#define SOFTSCOPE_SYMBOLIZER_OPTION ""
#endif

extern "C" {

// intercept_tls_get_addr is off: the run time of clang 14 takes a library's thread-local block that
// happens to begin 16 bytes into a page for one with glibc 2.19's header, reads garbage as its
// address, and the search for leaks crashes there (github.com/google/sanitizers/issues/1322). What
// such blocks hold is found all the same, by use_ld_allocations: tests/house/thread_blocks.cpp.
const char* __asan_default_options() {
  return "detect_leaks=1:detect_stack_use_after_return=1:strict_init_order=1:"
         "check_initialization_order=1:intercept_tls_get_addr=0" SOFTSCOPE_SYMBOLIZER_OPTION;
}

const char* __ubsan_default_options() { return "print_stacktrace=1"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

// What these libraries keep until the process ends is theirs. fontconfig's patterns hold distances
// instead of addresses, so that the search takes all that they hold for lost.
const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n"
         "leak:libEGL_mesa\n"
         "leak:libGLX_mesa\n"
         "leak:swrast_dri\n"
         "leak:libLLVM\n";
}
}
