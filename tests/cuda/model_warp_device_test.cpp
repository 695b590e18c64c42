// tests/cuda/model_warp_device_test.cpp: the GPU carries the model's points as the CPU does.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "cuda/surface/surface.h"
#include "cuda/warp/model_warp.h"
#include "model_warp_cases.h"

namespace softscope::test {
namespace {

/// Seen through a search on the same model: the points of the warped one are found at their places.
TEST(ModelWarpOnDevice, IsThatOfTheCpu) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const ModelWarpScene scene;
  const PointModel expected = scene.expected();
  PointModel model = scene.model;
  const auto shared = cuda::makeSharedModel();
  const auto warp = cuda::makeModelWarp(shared);
  const auto search = cuda::makeSurfaceSearch(shared);
  EXPECT_FALSE(warp->apply(scene.graph, &model));
  const std::vector<std::int32_t> found = search->nearestPoints(model, expected.positions_mm);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], static_cast<int>(i));
  warp->undo(&model);
  const std::vector<std::int32_t> again = search->nearestPoints(model, model.positions_mm);
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i], static_cast<int>(i));
}

}  // namespace
}  // namespace softscope::test
