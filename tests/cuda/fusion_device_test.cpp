// tests/cuda/fusion_device_test.cpp: stage 7 on the GPU gives the CPU's model.
#include <gtest/gtest.h>

#include "cuda/comparison/comparison.h"
#include "cuda/device/device_info.h"
#include "cuda/frame/survey.h"
#include "cuda/fusion/fusion.h"
#include "fusion_cases.h"

namespace softscope::test {
namespace {

class FusionOnDevice : public testing::TestWithParam<ComparisonCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(FusionOnDevice, UpdatesTheModelAsTheCpuDoes) {
  const FusionScene scene(GetParam());
  CpuModelUpdater cpu;
  const auto device = cuda::makeModelUpdater(FusionScene::camera());
  expectSameUpdate(scene.begin(device.get()), scene.begin(&cpu));
  const UpdatedModel expected = scene.goOn(&cpu);
  for (int frame = 0; frame < 3; ++frame) expectSameUpdate(scene.goOn(device.get()), expected);
  expectSameUpdate(thinCrowd(scene, device.get()), thinCrowd(scene, &cpu));
}

TEST_P(FusionOnDevice, FindsTheModelWhereTheComparerLeftIt) {
  const FusionScene scene(GetParam());
  CpuModelUpdater cpu;
  const auto apart = cuda::makeFrameComparer(FusionScene::camera());
  const UpdatedModel expected = scene.follow(apart.get(), &cpu);
  const auto frames = std::make_shared<cuda::SharedFrames>();
  const std::shared_ptr<const cuda::SharedRasters> rasters(frames, &frames->at_hand);
  const auto model = cuda::makeSharedModel();
  const auto comparer = cuda::makeFrameComparer(FusionScene::camera(), rasters, model);
  const auto updater = cuda::makeModelUpdater(FusionScene::camera(), rasters, model);
  expectSameUpdate(scene.follow(comparer.get(), updater.get()), expected);
  const auto survey = cuda::makeFrameSurvey(FusionScene::camera(), frames);
  expectSameUpdate(scene.follow(comparer.get(), updater.get(), survey.get()), expected);
}

INSTANTIATE_TEST_SUITE_P(Cuda, FusionOnDevice, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope::test
