// cmake/sanitizer_defaults.cpp: default options of sanitized programs.

// LeakSanitizer calls llvm-symbolizer for the names of every frame before it compares one with
// the suppressions below, though those name libraries and need no symbols; without a symbolizer
// it complains on stderr, also in programs without leaks. An empty path avoids the call.
#ifdef SOFTSCOPE_NO_SYMBOLIZER
#define SOFTSCOPE_SYMBOLIZER_OPTION ":external_symbolizer_path="
#else
#define SOFTSCOPE_SYMBOLIZER_OPTION ""
#endif

extern "C" {

// intercept_tls_get_addr is off: the run time of clang 14 mistakes a thread-local block that
// happens to begin 16 bytes into a page for one with the header of glibc 2.19, reads an invalid
// address, and the leak search crashes (github.com/google/sanitizers/issues/1322). The contents
// of such blocks are still found, by use_ld_allocations: tests/house/thread_blocks.cpp.
//
// quarantine_size_mb: freed memory is taken again after 32 MB of other memory were freed, all that
// a small frame frees, instead of 256, which takes new pages all the while.
const char* __asan_default_options() {
  return "detect_leaks=1:detect_stack_use_after_return=1:strict_init_order=1:"
         "check_initialization_order=1:intercept_tls_get_addr=0:"
         "quarantine_size_mb=32" SOFTSCOPE_SYMBOLIZER_OPTION;
}

const char* __ubsan_default_options() { return "print_stacktrace=1"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

// Memory that these libraries keep until the process ends. The patterns of fontconfig hold
// distances instead of addresses, so that the search reports everything they hold as lost.
const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n"
         "leak:libEGL_mesa\n"
         "leak:libGLX_mesa\n"
         "leak:swrast_dri\n"
         "leak:libLLVM\n";
}
}
