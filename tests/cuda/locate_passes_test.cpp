// tests/cuda/locate_passes_test.cpp: view, matching and lift in one go, run on the host in shuffled
// orders, give the CPU's bytes.
#include "cuda/locate_passes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "cuda/host_executor.h"
#include "host_memory.h"
#include "locate_cases.h"

namespace softscope {
namespace {

/// The kernels by the host executor; `seen_gray` as in cpuLifted().
std::vector<LiftedMatch> hostLifted(const test::LocateScene& scene, const GrayImage& seen_gray,
                                    unsigned seed) {
  const int width = scene.camera.width_px, height = scene.camera.height_px;
  const int points = static_cast<int>(scene.model.size());
  cuda::Arena counting;
  cuda::LocateLayout(counting, MatcherOptions(), width, height, points);
  test::HostMemory memory(counting.bytes());
  cuda::Arena arena(memory.data());
  const cuda::LocateLayout layout(arena, MatcherOptions(), width, height, points);
  const auto copy = [](void* to, const auto& from) {
    if (!from.empty())
      std::memcpy(to, static_cast<const void*>(from.data()), from.size() * sizeof from[0]);
  };
  copy(layout.view.positions_mm, scene.model.positions_mm);
  copy(layout.view.normals, scene.model.normals);
  copy(layout.view.colours, scene.model.colours);
  copy(layout.view.anchors, scene.model.anchors);
  *layout.view.point_count = points;
  *layout.view.camera = viewProjector(scene.camera, scene.world_from_left, scene.view_options);
  const cuda::MatchScale& full = layout.match.levels.front();
  copy(full.gray[1].data, scene.live.gray.values);
  copy(layout.match.mask[1].data, scene.live.ignore.values);
  copy(full.gray[0].data, seen_gray.values);
  copy(layout.live_depth.data, scene.depth.depth_mm.values);
  copy(layout.live_sigma.data, scene.depth.sigma_mm.values);
  *layout.inputs = {scene.camera, rigidRows(scene.world_from_left)};
  *layout.match.inputs = {seen_gray.empty() ? 1 : 0, {1, 1}};
  cuda::HostExecutor executor(seed);
  cuda::LocatePasses<cuda::HostExecutor>(executor, layout)
      .locate(scene.view_options, !seen_gray.empty());
  return cuda::liftedMatches(layout.list, *layout.lifted_count);
}

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
      EXPECT_EQ(test::differingLifted(hostLifted(scene, seen_gray, seed), expected), 0);
  }
}

}  // namespace
}  // namespace softscope
