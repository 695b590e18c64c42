// tests/cuda/warp_passes_test.cpp: the kernels of the warp, run on the host in shuffled orders,
// find the CPU's warp.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/warp/warp_run.h"
#include "deform/cholesky/block_pattern.h"
#include "deform/cholesky/dissection.h"
#include "host_machine.h"
#include "same_search.h"
#include "warp_cases.h"

namespace softscope {
namespace {

std::unique_ptr<DeformSolver> solverOnTheHost(const test::WarpScene& scene, unsigned seed) {
  auto device = std::make_unique<cuda::WarpRun<test::HostMachine>>(scene.weights(), seed);
  return scene.local(
      makeDeformSolver(scene.options(), makeDeviceWarpSystem(scene.options(), std::move(device))));
}

class WarpPasses : public testing::TestWithParam<test::WarpCase> {};

TEST_P(WarpPasses, FindTheCpusWarpInAnyOrderOfThreads) {
  const test::WarpScene scene(GetParam()), other(test::warpCases().front());
  const test::WarpScene::Found expected = scene.solve(scene.solverOnTheCpu().get());
  const auto solver = solverOnTheHost(scene, 1), shuffled = solverOnTheHost(scene, 77);
  other.solve(shuffled.get());  // nothing is left of another frame
  const test::WarpScene::Found found = scene.solve(solver.get());
  test::expectSameSearch(found.summary, expected.summary);
  EXPECT_LT(test::furthestApart(found.graph, expected.graph), 1e-6);
  EXPECT_EQ(test::furthestApart(found.graph, scene.solve(shuffled.get()).graph), 0);
  EXPECT_EQ(test::furthestApart(found.graph, scene.solve(solver.get()).graph), 0);
}

INSTANTIATE_TEST_SUITE_P(Cuda, WarpPasses, testing::ValuesIn(test::warpCases()),
                         [](const auto& each) { return each.param.name; });

TEST(WarpPassesEdge, RastersOnTheDeviceAreTakenFromThere) {
  const test::WarpScene scene(test::warpCases()[1]);
  const DepthMap& depth = scene.depth();
  std::vector<float> depth_mm = depth.depth_mm.values, sigma_mm = depth.sigma_mm.values;
  const auto shared = std::make_shared<cuda::SharedRasters>();
  *shared = {depth.depth_mm.values.data(), depth_mm.data(), sigma_mm.data(),
             scene.normals().values.data()};
  auto device = std::make_unique<cuda::WarpRun<test::HostMachine>>(scene.weights(), 1U);
  device->share(shared);
  const auto solver =
      makeDeformSolver(scene.options(), makeDeviceWarpSystem(scene.options(), std::move(device)));
  const test::WarpScene::Found expected = scene.solve(solverOnTheHost(scene, 1).get());
  EXPECT_EQ(test::furthestApart(scene.solve(solver.get()).graph, expected.graph), 0);
  depth_mm.assign(depth_mm.size(), NAN);  // of the copy alone
  EXPECT_EQ(scene.solve(solver.get()).summary.reason, StopReason::kNothingToFit);
  *shared = {};
  EXPECT_EQ(test::furthestApart(scene.solve(solver.get()).graph, expected.graph), 0);
}

std::unique_ptr<DeformSolver> solverWithTheModel(
    const test::WarpScene& scene, unsigned seed,
    std::shared_ptr<cuda::ModelHome<test::HostMachine>> home) {
  auto device = std::make_unique<cuda::WarpRun<test::HostMachine>>(scene.weights(), seed);
  device->share(std::move(home));
  return scene.local(
      makeDeformSolver(scene.options(), makeDeviceWarpSystem(scene.options(), std::move(device))));
}

TEST_P(WarpPasses, TakePointsFromTheModelOnTheDevice) {
  const test::WarpScene scene(GetParam());
  const std::vector<std::uint8_t> seen = scene.visible();
  const auto home = std::make_shared<cuda::ModelHome<test::HostMachine>>();
  home->setSeen(seen.data());
  const auto solver = solverWithTheModel(scene, 1, home);
  const test::WarpScene::Found expected = scene.solve(solverOnTheHost(scene, 1).get());
  const test::WarpScene::Found found = scene.solve(solver.get());
  EXPECT_EQ(found.summary.points_after, expected.summary.points_after);
  EXPECT_LT(test::furthestApart(found.graph, expected.graph), 1e-6);
  const test::WarpScene::Found shuffled = scene.solve(solverWithTheModel(scene, 77, home).get());
  EXPECT_EQ(test::furthestApart(found.graph, shuffled.graph), 0);
}

// Without a list on the device, the solver sends the host's list.
TEST(WarpPassesEdge, PointsAreTakenFromTheHostWhereTheDeviceHasNoList) {
  const test::WarpScene scene(test::warpCases()[1]);
  const test::WarpScene::Found expected = scene.solve(solverOnTheHost(scene, 1).get());
  const auto home = std::make_shared<cuda::ModelHome<test::HostMachine>>();
  const auto solver = solverWithTheModel(scene, 1, home);
  EXPECT_EQ(test::furthestApart(scene.solve(solver.get()).graph, expected.graph), 0);
  const std::vector<std::uint8_t> nothing(scene.model().size(), 0);
  home->setSeen(nothing.data());
  EXPECT_EQ(scene.solve(solver.get()).summary.points_before, 0);
  home->changed(kModelShape);  // and so is what it was compared with
  EXPECT_EQ(test::furthestApart(scene.solve(solver.get()).graph, expected.graph), 0);
}

TEST(WarpPassesEdge, AffineNodesAreRefused) {
  const test::WarpScene scene(test::warpCases().front());
  DeformOptions affine = scene.options();
  affine.node_model = NodeModel::kAffine;
  EXPECT_THROW(makeDeviceWarpSystem(
                   affine, std::make_unique<cuda::WarpRun<test::HostMachine>>(scene.weights(), 1U)),
               OptionError);
}

TEST(WarpPassesEdge, ALargeGraphIsSolvedAroundWhatIsSeen) {
  const test::WarpScene scene(test::warpCases().back());
  const std::vector<std::uint8_t> afar = scene.solve(solverOnTheHost(scene, 1).get()).graph.afar;
  EXPECT_GT(std::count(afar.begin(), afar.end(), 1), 200);
  EXPECT_GT(std::count(afar.begin(), afar.end(), 0), 100);
}

/// Each node is eliminated once, and its neighbours then are in its front.
TEST(Dissection, FrontsHoldAllThatTheirPivotsTouch) {
  PointModel model = scenes::makeHill(60, 40, 0.7);
  const BlockPattern pattern = makeBlockPattern(scenes::bindGraph(&model, 3));
  const EliminationTree tree = dissect(pattern, 5);
  std::vector<int> eliminated(static_cast<std::size_t>(pattern.nodes()), 0);
  for (const Supernode& front : tree.supernodes) {
    for (int c = 0; c < front.columns; ++c) ++eliminated[tree.order[front.first + c]];
    EXPECT_EQ(front.rows.empty(), front.parent < 0);
    EXPECT_LE(front.columns, 5);
  }
  for (const int times : eliminated) EXPECT_EQ(times, 1);
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j] + 1; b < pattern.column_start[j + 1]; ++b) {
      const int low = std::min(tree.position[j], tree.position[pattern.row[b]]);
      const int high = std::max(tree.position[j], tree.position[pattern.row[b]]);
      const Supernode& front = tree.supernodes[tree.supernode_of[low]];
      EXPECT_TRUE(high < front.first + front.columns ||
                  std::binary_search(front.rows.begin(), front.rows.end(), high));
    }
  EXPECT_GT(tree.supernodes.size(), 20U);
}

}  // namespace
}  // namespace softscope
