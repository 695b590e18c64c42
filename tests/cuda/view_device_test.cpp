// tests/cuda/view_device_test.cpp: the model view on the GPU has the CPU's bytes.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/device/device_info.h"
#include "cuda/view/view.h"
#include "view_cases.h"

namespace softscope {
namespace {

class ViewOnDevice : public testing::TestWithParam<test::ViewCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(ViewOnDevice, HasTheCpusBytesViewAfterView) {
  const PinholeCamera camera = test::cameraOf(GetParam());
  ModelViewOptions options;
  options.gap_px = GetParam().gap_px;
  const PointModel model = test::modelOf(GetParam());
  cuda::ModelRenderer renderer(camera, options, GetParam().points);
  renderer.upload(model);
  for (const Eigen::Isometry3d& pose :
       {GetParam().world_from_left, test::poseAt(1, 1, 30, 0.3), GetParam().world_from_left}) {
    renderer.draw(pose);
    EXPECT_EQ(
        test::differingPixels(renderer.download(), renderModelView(model, camera, pose, options)),
        0);
  }
}

INSTANTIATE_TEST_SUITE_P(Cuda, ViewOnDevice, testing::ValuesIn(test::viewCases()),
                         [](const auto& each) { return each.param.name; });

TEST(ViewOnDeviceErrors, MorePointsThanTheCapacityAreRefused) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const test::ViewCase of = test::viewCases().front();
  cuda::ModelRenderer renderer(test::cameraOf(of), {}, of.points - 1);
  EXPECT_THROW(renderer.upload(test::modelOf(of)), Error);
}

}  // namespace
}  // namespace softscope
