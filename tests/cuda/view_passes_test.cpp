// tests/cuda/view_passes_test.cpp: the kernels of the model view, run on the host in shuffled
// orders, give the CPU's bytes.
#include <gtest/gtest.h>

#include "host_view.h"
#include "view_cases.h"

namespace softscope {
namespace {

class ViewPasses : public testing::TestWithParam<test::ViewCase> {
 protected:
  ViewPasses() : model_(test::modelOf(GetParam())) { options_.gap_px = GetParam().gap_px; }

  PointModel model_;
  ModelViewOptions options_;
};

TEST_P(ViewPasses, GiveTheCpusView) {
  const PinholeCamera camera = test::cameraOf(GetParam());
  const ModelView expected = renderModelView(model_, camera, GetParam().world_from_left, options_);
  for (const unsigned seed : {1U, 77U}) {
    test::HostView host(camera, GetParam().points, seed);
    host.draw(model_, test::poseAt(1, 1, 30, 0.3), options_);  // nothing is left of another view
    EXPECT_EQ(
        test::differingPixels(host.draw(model_, GetParam().world_from_left, options_), expected),
        0);
  }
}

INSTANTIATE_TEST_SUITE_P(Cuda, ViewPasses, testing::ValuesIn(test::viewCases()),
                         [](const auto& each) { return each.param.name; });

TEST(ViewPassesEdge, AnEmptyModelGivesAnEmptyView) {
  const PinholeCamera camera = test::cameraOf(test::viewCases().front());
  const Eigen::Isometry3d home = Eigen::Isometry3d::Identity();
  test::HostView host(camera, 10, 1);
  EXPECT_EQ(test::differingPixels(host.draw(PointModel(), home, {}),
                                  renderModelView(PointModel(), camera, home, {})),
            0);
}

}  // namespace
}  // namespace softscope
