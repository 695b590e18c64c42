// tests/cuda/locate_passes_test.cpp: view, matching and lift in one go, run on the host in shuffled
// orders, give the CPU's bytes.
#include <gtest/gtest.h>

#include "host_locate.h"
#include "locate_cases.h"

namespace softscope {
namespace {

TEST(LocatePasses, GiveTheCpusLiftedMatches) {
  const test::LocateScene scene = test::locateScene();
  GrayImage seen(240, 192);  // as it looked from the world's origin, so somewhat off
  for (int v = 0; v < 192; ++v)
    for (int u = 0; u < 240; ++u) {
      const Eigen::Vector3d at = liftPixel<double>(scene.camera, u, v, 50.0);
      seen.at(u, v) = static_cast<std::uint8_t>(test::planeGray(at.x(), at.y()));
    }
  for (const GrayImage& seen_gray : {GrayImage(), seen}) {
    const std::vector<LiftedMatch> expected = test::cpuLifted(scene, seen_gray);
    EXPECT_GT(expected.size(), 300U);
    for (const unsigned seed : {1U, 77U})
      EXPECT_EQ(
          test::differingLifted(
              test::locateOnTheHost(scene.camera, scene.view_options, MatcherOptions(), scene.model,
                                    scene.world_from_left, seen_gray, scene.live, scene.depth, seed)
                  .lifted,
              expected),
          0);
  }
}

}  // namespace
}  // namespace softscope
