// tests/cuda/survey_device_test.cpp: frames surveyed by the GPU give the CPU's numbers and states.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "cuda/frame/survey.h"
#include "survey_cases.h"

namespace softscope::test {
namespace {

TEST(SurveyOnDevice, GivesTheCpusNumbersAndStatesFrameAfterFrame) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const auto survey =
      cuda::makeFrameSurvey(ComparisonScene::camera(), std::make_shared<cuda::SharedFrames>());
  expectTheCpusSurvey(survey.get());
}

}  // namespace
}  // namespace softscope::test
