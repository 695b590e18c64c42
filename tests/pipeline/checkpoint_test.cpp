// tests/pipeline/checkpoint_test.cpp: a state survives, a damaged file doesn't pass.
#include "pipeline/checkpoint.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace softscope {
namespace {

Checkpoint someCheckpoint() {
  Checkpoint checkpoint;
  checkpoint.settings = "digest";
  checkpoint.next_frame = 17;
  ModelState& model = checkpoint.state.model;
  model.model.add({1, 2, 3}, {0, 0, -1}, {4, 5, 6}, 7);
  model.graph.positions_mm = {{1, 2, 3}, {4, 5, 6}};
  model.graph.transforms.resize(2);
  model.graph.edges = {{0, 1, 0.5}};
  model.graph.stencils = {{0, 1, 1, 1}};
  model.memory.unexplained_mm = Raster<float>(3, 2, 8.0f);
  MaterialPoints::Point point;
  point.id = 9;
  point.model_point = 0;
  point.position_mm = {1, 2, 3};
  point.pixels_mm(2, 1) = 0.5;
  point.look.windows.back().gray.back() = 77;
  model.tracked.points.push_back(point);
  model.last.left = ColourImage(2, 1, {7, 8, 9});
  model.exposure = {0.9f, 1.1f, 1.2f};
  model.errors.depth_mm = Raster<float>(2, 1, 80.0f);
  model.errors.variance_mm2 = Raster<float>(2, 1, 0.25f);
  model.errors.nodes_mm2 = {0.5f, 0.75f};
  model.errors.reference_sigma_mm = 0.1;
  ScopeState& scope = checkpoint.state.scope;
  scope.map = 2;
  scope.world_from_left.translation() = Eigen::Vector3d(1, 2, 3);
  scope.key_views.resize(2, scope.world_from_left);
  scope.lost = true;
  scope.scope_moves = true;
  scope.fused_frames = 12;
  scope.unfused_frames = 3;
  scope.searches = 2;
  checkpoint.state.others.push_back({model, scope});
  checkpoint.state.others[0].scope.map = 1;
  checkpoint.state.maps = 3;
  return checkpoint;
}

std::string bytesOf(const Checkpoint& checkpoint) {
  const ReconstructionState& state = checkpoint.state;
  return checkpointBytes({checkpoint.settings,
                          checkpoint.next_frame,
                          {state.model, state.scope, state.others, state.maps}});
}

TEST(Checkpoint, ComesBackAsItWas) {
  const Checkpoint before = someCheckpoint();
  const std::string bytes = bytesOf(before);
  const Checkpoint after = parseCheckpoint(bytes, "c");
  EXPECT_EQ(after.settings, "digest");
  EXPECT_EQ(after.next_frame, 17);
  EXPECT_EQ(after.state.model.model.positions_mm[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(after.state.model.graph.edges[0].weight, 0.5);
  EXPECT_EQ(after.state.model.memory.unexplained_mm.at(2, 1), 8.0f);
  EXPECT_EQ(after.state.model.tracked.points[0].id, 9);
  EXPECT_EQ(after.state.model.tracked.points[0].pixels_mm(2, 1), 0.5);
  EXPECT_EQ(after.state.model.tracked.points[0].look.windows.back().gray.back(), 77);
  EXPECT_EQ(after.state.model.exposure.green, 1.1f);
  EXPECT_EQ(after.state.model.last.left.at(1, 0), (Rgb8{7, 8, 9}));
  EXPECT_EQ(after.state.model.errors.variance_mm2.at(1, 0), 0.25f);
  EXPECT_EQ(after.state.model.errors.nodes_mm2[1], 0.75f);
  EXPECT_EQ(after.state.model.errors.reference_sigma_mm, 0.1);
  EXPECT_EQ(after.state.scope.map, 2);
  EXPECT_TRUE(after.state.scope.lost);
  EXPECT_TRUE(after.state.scope.scope_moves);
  EXPECT_EQ(after.state.scope.fused_frames, 12);
  EXPECT_EQ(after.state.scope.unfused_frames, 3);
  EXPECT_EQ(after.state.scope.searches, 2);
  EXPECT_EQ(after.state.maps, 3);
  ASSERT_EQ(after.state.others.size(), 1u);
  EXPECT_EQ(after.state.others[0].scope.map, 1);
  EXPECT_EQ(after.state.others[0].model.model.weights[0], 7.0f);
  EXPECT_EQ(bytesOf(after), bytes);
}

TEST(Checkpoint, EveryDamageIsNoticed) {
  const std::string bytes = bytesOf(someCheckpoint());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_THROW(parseCheckpoint(damaged, "c"), InputError) << i;
    EXPECT_THROW(parseCheckpoint(std::string_view(bytes).substr(0, i), "c"), InputError) << i;
  }
}

}  // namespace
}  // namespace softscope
