// tests/cuda/pose_passes_test.cpp: the kernels of the pose, run on the host in shuffled orders,
// find the CPU's pose.
#include <gtest/gtest.h>

#include "cuda/pose/pose_run.h"
#include "host_machine.h"
#include "pose_cases.h"

namespace softscope {
namespace {

class PosePasses : public testing::TestWithParam<test::PoseCase> {};

TEST_P(PosePasses, FindTheCpusPoseInAnyOrderOfThreads) {
  const PoseQuestion question = test::poseQuestionOf(GetParam());
  cuda::PoseRun<test::HostMachine> search(1U), shuffled(77U);
  const PoseAnswer found = search.answer(question);
  test::expectSame(found, CpuPoseSearch().answer(question));
  shuffled.answer(test::poseQuestionOf(test::poseCases().front()));  // nothing of it is left
  EXPECT_TRUE(test::equal(found, shuffled.answer(question)));
  EXPECT_TRUE(test::equal(found, search.answer(question)));
}

INSTANTIATE_TEST_SUITE_P(Cuda, PosePasses, testing::ValuesIn(test::poseCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope
