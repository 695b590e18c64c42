// tests/cuda/stereo_passes_test.cpp: the kernels of stereo, run on the host in shuffled orders,
// give the CPU's bytes.
#include <gtest/gtest.h>

#include "host_stereo.h"
#include "stereo/matching/dense_matching.h"
#include "stereo/matching/row_prior.h"
#include "stereo/matching/support_points.h"
#include "stereo_cases.h"

namespace softscope {
namespace {

using test::differing;
using test::measuredOf;

class StereoPasses : public testing::TestWithParam<test::StereoCase> {
 protected:
  StereoPasses()
      : scene_(test::steppedScene(GetParam().width, GetParam().height)),
        views_(test::viewsOf(scene_, GetParam())),
        mask_(test::maskOf(GetParam())),
        host_(GetParam().options, GetParam().width, GetParam().height, 1) {
    host_.compute(views_, scene_.rig, GetParam().roll_rad, mask_);
  }
  const cuda::StereoLevel& full() const { return host_.layout().levels.front(); }

  test::Scene scene_;
  MatchableViews views_;
  Mask mask_;
  test::HostStereo host_;
};

TEST_P(StereoPasses, FindTheCpusSupportAndPrior) {
  const StereoOptions& options = GetParam().options;
  const GradientImage left(views_.left, options.elas.gradient_gain, options.disparity_max_px,
                           views_.ignored.left),
      right(views_.right, options.elas.gradient_gain, options.disparity_max_px,
            views_.ignored.right);
  const auto points = findSupportPoints(left, right, options);
  Raster<float> expected(full().grid.columns, full().grid.rows, kNoSupport);
  for (const SupportPoint& p : points)
    expected.at(p.u_px / full().grid.step, p.v_px / full().grid.step) = p.disparity_px;
  const cuda::View<float> kept{full().kept, full().grid.columns, full().grid.rows,
                               full().grid.columns};
  ASSERT_GT(points.size(), 20U);
  EXPECT_EQ(differing(test::rasterOf(kept), expected), 0);
  EXPECT_EQ(full().counters->point_count, static_cast<int>(points.size()));

  const auto priorOf = [&](const std::vector<SupportPoint>& from) {
    return interpolateRows(from, GetParam().width, GetParam().height);
  };
  const Raster<std::int16_t> prior = priorOf(points);
  EXPECT_EQ(differing(test::rasterOf(full().prior[0]), prior), 0);

  const auto from_right = supportFromRight(points);
  EXPECT_EQ(differing(test::rasterOf(full().prior[1]), priorOf(from_right)), 0);
  EXPECT_EQ(differing(test::rasterOf(full().whole[0]),
                      matchDense(left, right, Reference::kLeft, points, options)),
            0);
  EXPECT_EQ(differing(test::rasterOf(full().whole[1]),
                      matchDense(left, right, Reference::kRight, from_right, options)),
            0);
}

TEST_P(StereoPasses, GiveTheCpusDepthAndNormals) {
  const test::CpuDepth cpu(scene_, GetParam(), mask_);
  const cuda::StereoLayout& found = host_.layout();
  ASSERT_GT(measuredOf(cpu.disparity.disparity_px), GetParam().width * GetParam().height / 3);
  EXPECT_EQ(differing(test::rasterOf(found.disparity), cpu.disparity.disparity_px), 0);
  EXPECT_EQ(differing(test::rasterOf(found.sigma), cpu.disparity.sigma_px), 0);
  EXPECT_EQ(differing(test::rasterOf(found.depth), cpu.depth.depth_mm), 0);
  EXPECT_EQ(differing(test::rasterOf(found.depth_sigma), cpu.depth.sigma_mm), 0);
  const Raster<cuda::NormalPixel> normals = test::rasterOf(found.normals);
  EXPECT_EQ(test::differingNormals(normals, cpu.normals), 0);
}

TEST_P(StereoPasses, GiveTheSameInAnyOrderOfThreads) {
  test::HostStereo other(GetParam().options, GetParam().width, GetParam().height, 77);
  for (int frame = 0; frame < 2; ++frame)  // nothing is left of the frame before
    other.compute(frame == 0 ? MatchableViews{scene_.right, scene_.right, {}} : views_, scene_.rig,
                  GetParam().roll_rad, mask_);
  EXPECT_EQ(other.levelsRun(), host_.levelsRun());
  EXPECT_EQ(
      differing(test::rasterOf(other.layout().disparity), test::rasterOf(host_.layout().disparity)),
      0);
  EXPECT_EQ(differing(test::rasterOf(other.layout().sigma), test::rasterOf(host_.layout().sigma)),
            0);
}

INSTANTIATE_TEST_SUITE_P(Cuda, StereoPasses, testing::ValuesIn(test::stereoCases()),
                         [](const auto& each) { return each.param.name; });

TEST(StereoPassesEdge, AnImageWithoutTextureHasNoDepth) {
  const GrayImage flat(96, 80, 100);
  test::HostStereo host(test::optionsTo(64), 96, 80, 1);
  host.compute({flat, flat, {}}, test::endoscope());
  EXPECT_EQ(measuredOf(test::rasterOf(host.layout().disparity)), 0);
}

}  // namespace
}  // namespace softscope
