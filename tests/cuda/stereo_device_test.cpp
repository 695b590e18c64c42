// tests/cuda/stereo_device_test.cpp: stereo on the GPU gives the CPU's bytes, frame after frame.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "core/error.h"
#include "cuda/device/device_info.h"
#include "cuda/stereo/stereo.h"
#include "stereo_cases.h"

namespace softscope {
namespace {

using test::differing;

struct Normal {
  float x, y, z;
};
Raster<Normal> listed(const NormalMap& normals) {
  Raster<Normal> list(normals.width_px, normals.height_px);
  for (std::size_t i = 0; i < list.size(); ++i)
    list.values[i] = {normals.values[i].x(), normals.values[i].y(), normals.values[i].z()};
  return list;
}

/// Down to the payload of NaN: these are written to files.
bool sameBytes(const Raster<float>& a, const Raster<float>& b) {
  return a.sameShape(b) &&
         std::memcmp(a.values.data(), b.values.data(), a.size() * sizeof(float)) == 0;
}

void expectEqual(const cuda::StereoDepth& found, const test::CpuDepth& cpu) {
  EXPECT_EQ(differing(found.disparity.disparity_px, cpu.disparity.disparity_px), 0);
  EXPECT_EQ(differing(found.disparity.sigma_px, cpu.disparity.sigma_px), 0);
  EXPECT_EQ(differing(found.depth.depth_mm, cpu.depth.depth_mm), 0);
  EXPECT_EQ(differing(found.depth.sigma_mm, cpu.depth.sigma_mm), 0);
  EXPECT_TRUE(sameBytes(found.disparity.disparity_px, cpu.disparity.disparity_px));
  EXPECT_TRUE(sameBytes(found.disparity.sigma_px, cpu.disparity.sigma_px));
  EXPECT_TRUE(sameBytes(found.depth.depth_mm, cpu.depth.depth_mm));
  EXPECT_TRUE(sameBytes(found.depth.sigma_mm, cpu.depth.sigma_mm));
  EXPECT_EQ(test::differingNormals(listed(found.normals), cpu.normals), 0);
}

class StereoOnDevice : public testing::TestWithParam<test::StereoCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(StereoOnDevice, GivesTheCpusDepthFrameAfterFrame) {
  const test::StereoCase& of = GetParam();
  test::Scene scene = test::steppedScene(of.width, of.height);
  cuda::Stereo stereo(of.options, scene.rig, of.width, of.height);
  const Mask mask = test::maskOf(of);
  stereo.setMask(mask);
  for (int frame = 0; frame < 3; ++frame) {
    const test::CpuDepth cpu(scene, of, mask);
    stereo.timeStages(frame == 2);  // launched one by one, not as graphs
    stereo.upload(test::viewsOf(scene, of));
    stereo.compute(of.roll_rad);
    expectEqual(stereo.download(), cpu);
    std::swap(scene.left, scene.right);  // another frame: little can be matched
  }
  EXPECT_FALSE(stereo.stageTimes().empty());
}

INSTANTIATE_TEST_SUITE_P(Cuda, StereoOnDevice, testing::ValuesIn(test::stereoCases()),
                         [](const auto& each) { return each.param.name; });

TEST(StereoOnDevice, DropsMaskedPixels) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const test::StereoCase of = test::stereoCases().front();
  const test::Scene scene = test::steppedScene(of.width, of.height);
  cuda::Stereo stereo(of.options, scene.rig, of.width, of.height);
  stereo.upload(test::viewsOf(scene, of));
  stereo.compute(of.roll_rad);
  const cuda::StereoDepth all = stereo.download();
  Mask mask(of.width, of.height, 0);
  for (int v = 0; v < of.height; ++v)
    for (int u = v % 7; u < of.width; u += 3) mask.at(u, v) = 1;
  stereo.drop(mask);
  const cuda::StereoDepth left = stereo.download();
  const auto expectDropped = [&](const Raster<float>& found, const Raster<float>& before) {
    Raster<float> expected = before;
    dropMasked(mask, &expected);
    EXPECT_TRUE(sameBytes(found, expected));
    EXPECT_FALSE(sameBytes(found, before));
  };
  expectDropped(left.depth.depth_mm, all.depth.depth_mm);
  expectDropped(left.depth.sigma_mm, all.depth.sigma_mm);
  expectDropped(left.disparity.disparity_px, all.disparity.disparity_px);
  expectDropped(left.disparity.sigma_px, all.disparity.sigma_px);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const Eigen::Vector3f &normal = left.normals.values[i], &before = all.normals.values[i];
    EXPECT_TRUE(mask.values[i] != 0 || before.hasNaN() ? normal.hasNaN() : normal == before);
  }
}

TEST(StereoOnDeviceErrors, AnotherShapeIsRefused) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  cuda::Stereo stereo(StereoOptions(), test::endoscope(), 96, 80);
  EXPECT_THROW(stereo.upload({GrayImage(95, 80), GrayImage(95, 80), {}}), InputError);
}

TEST(StereoOnDeviceErrors, WithoutADeviceTheReasonIsGiven) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (!info.devices.empty()) GTEST_SKIP() << "this machine has a GPU";
  try {
    cuda::Stereo stereo(StereoOptions(), test::endoscope(), 96, 80);
    FAIL() << "no device, and no error";
  } catch (const BackendError& error) {
    EXPECT_NE(std::string(error.what()).find(info.why_none), std::string::npos) << error.what();
  }
}

TEST(StereoOnDeviceErrors, AMethodWithoutKernelsIsRefused) {
  StereoOptions options;
  options.method = "sgbm";
  EXPECT_THROW(cuda::Stereo(options, test::endoscope(), 96, 80), OptionError);
}

}  // namespace
}  // namespace softscope
