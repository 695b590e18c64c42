// tests/cuda/match_device_test.cpp: matching on the GPU gives the CPU's bytes, frame after frame.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/device/device_info.h"
#include "cuda/match/match.h"
#include "match_cases.h"

namespace softscope {
namespace {

class MatchOnDevice : public testing::TestWithParam<test::MatchCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(MatchOnDevice, GivesTheCpusMatchesFrameAfterFrame) {
  test::WarpedPair pair = test::pairOf(GetParam());
  const auto cpu = makeFeatureMatcher(GetParam().options);
  cuda::Matcher matcher(GetParam().options, GetParam().width, GetParam().height);
  for (int frame = 0; frame < 3; ++frame) {
    matcher.timeStages(frame == 2);  // launched one by one, not as a graph
    const std::vector<PixelMatch> expected = cpu->match(pair.model, pair.live);
    EXPECT_GT(expected.size(), 100U);
    EXPECT_EQ(test::differingMatches(matcher.match(pair.model, pair.live), expected), 0);
    pair.model.anchor = {};  // the other frames have none
    std::swap(pair.model, pair.live);
  }
  EXPECT_FALSE(matcher.stageTimes().empty());
}

INSTANTIATE_TEST_SUITE_P(Cuda, MatchOnDevice, testing::ValuesIn(test::matchCases()),
                         [](const auto& each) { return each.param.name; });

TEST(MatchOnDeviceErrors, AnotherShapeIsRefused) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const MatchPicture narrow{GrayImage(119, 100), {}};
  EXPECT_THROW(cuda::Matcher(MatcherOptions(), 120, 100).match(narrow, narrow), InputError);
}

TEST(MatchOnDeviceErrors, WithoutADeviceTheReasonIsGiven) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (!info.devices.empty()) GTEST_SKIP() << "this machine has a GPU";
  EXPECT_THROW(cuda::Matcher(MatcherOptions(), 120, 100), BackendError);
}

}  // namespace
}  // namespace softscope
