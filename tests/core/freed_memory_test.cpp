// tests/core/freed_memory_test.cpp: memory that is freed and taken again needs no new pages.
#include "core/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

namespace softscope {
namespace {

long newPages() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

constexpr long kFewPages = 600;  // of the 6144 of the array, or 12 large ones

/// Pages that the system gives for an array of 24 MB.
long pagesOfAnArray() {
  const long before = newPages();
  const std::vector<char> array(std::size_t{24} << 20, 'x');
  return array.back() == 'x' ? newPages() - before : -1;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kOwnAllocator = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
constexpr bool kOwnAllocator = true;
#else
constexpr bool kOwnAllocator = false;
#endif
#else
constexpr bool kOwnAllocator = false;
#endif

TEST(FreedMemory, IsTakenAgainWithoutNewPages) {
#ifndef __GLIBC__
  GTEST_SKIP() << "the C library is not glibc";
#endif
  if (kOwnAllocator) GTEST_SKIP() << "a sanitizer has an allocator of its own";
  keepFreedMemory();
  pagesOfAnArray();
  EXPECT_LT(pagesOfAnArray(), kFewPages);
}

/// In a process of its own: heaps that threads of other tests have stay theirs.
TEST(FreedMemory, IsTakenByOtherThreadsOnFewCores) {
#ifndef __GLIBC__
  GTEST_SKIP() << "the C library is not glibc";
#endif
  if (kOwnAllocator) GTEST_SKIP() << "a sanitizer has an allocator of its own";
  if (std::thread::hardware_concurrency() > kMostCoresOfOneHeap)
    GTEST_SKIP() << "threads have heaps of their own";
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto ofAnotherThread = [] {
    keepFreedMemory();
    pagesOfAnArray();
    long pages = -1;
    std::thread([&] { pages = pagesOfAnArray(); }).join();
    std::fprintf(stderr, "%ld new pages\n", pages);
    std::_Exit(pages >= 0 && pages < kFewPages ? 0 : 1);
  };
  EXPECT_EXIT(ofAnotherThread(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace softscope
