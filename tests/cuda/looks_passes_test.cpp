// tests/cuda/looks_passes_test.cpp: the kernels that find first looks, run on the host in shuffled
// orders, find what the CPU does.
#include <gtest/gtest.h>

#include <algorithm>

#include "cuda/looks/looks_run.h"
#include "host_machine.h"
#include "looks_cases.h"

namespace softscope::test {
namespace {

TEST(LooksPasses, FindLooksAsTheCpuDoesInAnyOrderOfThreads) {
  const LookCases cases(1), others(5);
  const std::vector<FoundLook> found =
      findLooks(cases.sought, LookPicture(cases.now, cases.ignore));
  const auto found_count =
      std::count_if(found.begin(), found.end(), [](const FoundLook& look) { return look.found; });
  EXPECT_GT(found_count, 15);
  EXPECT_LT(found_count, 50);
  for (const unsigned seed : {1U, 77U}) {
    cuda::LooksRun<HostMachine> kernels(seed);
    expectSameLooks(cases, cases.ignore, &kernels);
    expectSameLooks(cases, Mask(), &kernels);
    kernels.forget();  // the numbers of other looks
    expectSameLooks(others, others.ignore, &kernels);
  }
}

/// What a larger picture, or more looks, leave to another frame.
TEST(LooksPasses, GrowWithTheLooks) {
  LookCases cases(2);
  cuda::LooksRun<HostMachine> kernels(3U);
  const std::vector<SoughtLook> all = cases.sought;
  cases.sought.erase(cases.sought.begin() + 10, cases.sought.end());
  for (SoughtLook& one : cases.sought) one.number -= 50;
  expectSameLooks(cases, cases.ignore, &kernels);
  kernels.forget();
  cases.sought = all;
  expectSameLooks(cases, cases.ignore, &kernels);
}

TEST(LooksPasses, TakeTheImageWhereItLies) {
  const LookCases cases(3);
  cuda::LooksRun<HostMachine> kernels(5U);
  cuda::SharedRasters rasters;
  rasters.match_gray = cases.now.values.data();
  rasters.ignore = cases.ignore.values.data();
  const GrayImage elsewhere(cases.now.width_px, cases.now.height_px, 0);
  const std::vector<FoundLook> found =
      kernels.find(cases.sought, elsewhere, cases.ignore, &rasters);
  const std::vector<FoundLook> expected =
      findLooks(cases.sought, LookPicture(cases.now, cases.ignore));
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].found, expected[k].found) << k;
}

TEST(LooksPasses, FindNothingWithoutLooks) {
  cuda::LooksRun<HostMachine> kernels(3U);
  EXPECT_TRUE(kernels.find({}, GrayImage(20, 20, 0), Mask(), nullptr).empty());
}

}  // namespace
}  // namespace softscope::test
