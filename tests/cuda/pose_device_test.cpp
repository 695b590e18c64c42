// tests/cuda/pose_device_test.cpp: the pose found on the GPU is the CPU's.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "cuda/pose/pose.h"
#include "pose_cases.h"

namespace softscope {
namespace {

class PoseOnDevice : public testing::TestWithParam<test::PoseCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(PoseOnDevice, IsTheCpusSearchAfterSearch) {
  const PoseQuestion question = test::poseQuestionOf(GetParam());
  const auto search = cuda::makePoseSearch();
  const PoseAnswer first = search->answer(question);
  test::expectSame(first, CpuPoseSearch().answer(question));
  search->answer(test::poseQuestionOf(test::poseCases().front()));
  EXPECT_TRUE(test::equal(first, search->answer(question)));
}

INSTANTIATE_TEST_SUITE_P(Cuda, PoseOnDevice, testing::ValuesIn(test::poseCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope
