// tests/fusion/innovation_test.cpp: where the warp was wrong, the model yields; elsewhere it holds:
// docs/fusion.md (F21) to (F23).
#include "fusion/innovation.h"

#include <gtest/gtest.h>

#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

constexpr float kDistanceMm = 55, kSigmaMm = 0.1f, kSlipMm = 0.6f;

/// Two nodes, left and right of the picture's middle, and points that each carries alone.
WarpGraph twoNodes() {
  WarpGraph graph;
  graph.positions_mm = {Eigen::Vector3d(-3, 0, kDistanceMm), Eigen::Vector3d(3, 0, kDistanceMm)};
  graph.transforms.resize(2);
  graph.stencils = {{0, 0, 0, 0}, {1, 1, 1, 1}};
  return graph;
}

/// A plane whose points have the error of `weight` averaged measurements; what the right node
/// carries was carried `slip_mm` too near.
PointModel carriedPlane(float weight, float slip_mm) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, kSigmaMm / std::sqrt(weight));
  PointModel model;
  for (float y = -3; y <= 3; y += 0.2f)
    for (float x = -4; x <= 4; x += 0.2f) {
      const bool right = x > 0;
      const float z = kDistanceMm + noise(random) - (right ? slip_mm : 0);
      model.add({x * z / kDistanceMm, y * z / kDistanceMm, z}, {0, 0, -1}, {150, 90, 80}, weight);
      model.bindings.back() = {right ? 1 : 0, {1, 0, 0, 0}};
    }
  return model;
}

Shot noisyPlane(unsigned seed) {
  Shot shot = takeShot(plane(kDistanceMm), smallCamera(), Eigen::Isometry3d::Identity(),
                       kSigmaMm / (kDistanceMm * kDistanceMm));
  addNoise(seed, &shot);
  return shot;
}

InnovationField fieldOf(const PointModel& model, const Shot& shot) {
  const FusionOptions options;
  const Observation observation = shot.observation();
  const Visibility visibility = findVisible(
      model, observation, classifyPixels(observation, options.pixels), options.visibility);
  return {model, twoNodes(), observation, visibility, options.points};
}

/// rms of the errors along z of one node's points.
double rmsOfSide(const PointModel& model, std::int32_t stencil) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (model.bindings[i].stencil == stencil)
      errors.push_back(model.positions_mm[i].z() - kDistanceMm);
  return rmsOf(errors);
}

// Variance of the difference: that of depth plus that of the model (sigma² / 9) plus the slip².
// About 600 points per side have a mean square to 6 %; a side counts as five points like the frame.
TEST(Innovation, TellsTheModelsErrorFromTheDepths) {
  const InnovationField field = fieldOf(carriedPlane(9, kSlipMm), noisyPlane(1));
  const WarpGraph graph = twoNodes();
  const Innovation left = field.at(graph, {0, {1, 0, 0, 0}});
  const Innovation right = field.at(graph, {1, {1, 0, 0, 0}});
  const float depth_mm2 = kSigmaMm * kSigmaMm, model_mm2 = depth_mm2 / 9;
  EXPECT_NEAR(left.difference_mm2, depth_mm2 + model_mm2, 0.25 * depth_mm2);
  EXPECT_NEAR(left.excess_mm2, model_mm2, 0.25 * depth_mm2);
  EXPECT_NEAR(right.excess_mm2, kSlipMm * kSlipMm + model_mm2, 0.08 * kSlipMm * kSlipMm);
  // Points of both are in between.
  WarpGraph shared = graph;
  shared.stencils.push_back({0, 1, 1, 1});
  const Innovation between = field.at(shared, {2, {0.25f, 0.75f, 0, 0}});
  EXPECT_NEAR(between.excess_mm2, 0.25f * left.excess_mm2 + 0.75f * right.excess_mm2, 1e-6);
}

TEST(Innovation, IsUnknownWithoutNodesOrDepthErrors) {
  const PointModel model = carriedPlane(9, kSlipMm);
  Shot shot = noisyPlane(1);
  EXPECT_EQ(fieldOf(model, shot).at(twoNodes(), {}).excess_mm2, 0);
  shot.depth.sigma_mm = {};
  EXPECT_EQ(fieldOf(model, shot).at(twoNodes(), {1, {1, 0, 0, 0}}).excess_mm2, 0);
}

PointModel updated(PointModel model, bool follow) {
  FusionOptions options;
  options.points.follow_innovation = follow;
  options.density.cell_mm = 0.02;
  InsertionMemory memory;
  update(noisyPlane(1), twoNodes(), options, &memory, &model);
  return model;
}

// With weight 9 the old rule leaves nine tenths of a slip (more, as soft truncation doubts it).
TEST(Innovation, LetsTheModelYieldWhereTheWarpWasWrongAndNowhereElse) {
  const PointModel carried = carriedPlane(9, kSlipMm);
  const PointModel followed = updated(carried, true), stubborn = updated(carried, false);
  EXPECT_GT(rmsOfSide(stubborn, 1), 0.85 * kSlipMm);
  EXPECT_LT(rmsOfSide(followed, 1), 1.2 * kSigmaMm);
  EXPECT_LT(rmsOfSide(followed, 0), 0.4 * kSigmaMm);  // one tenth of sigma² left: 0.32
}

// Beyond tau = 1 mm nothing was ever averaged, and nothing is let go before epsilon_d = 2 mm.
TEST(Innovation, BringsBackATissueThatIsFurtherOffThanTau) {
  const PointModel carried = carriedPlane(9, 1.5f);
  EXPECT_GT(rmsOfSide(updated(carried, false), 1), 1.4);
  EXPECT_LT(rmsOfSide(updated(carried, true), 1), 0.3);
}

// Two points in a hundred with an error of 1.5 mm are outliers, and do not
// affect those around them: these keep averaging, to sigma / sqrt(10).
TEST(Innovation, IsNotMovedByAFewWrongDepths) {
  PointModel model = carriedPlane(9, 0);
  for (std::size_t i = 0; i < model.size(); i += 50) model.positions_mm[i].z() -= 1.5f;
  const PointModel after = updated(model, true);
  std::vector<double> good;
  for (const Eigen::Vector3f& p : after.positions_mm)
    if (std::abs(p.z() - kDistanceMm) < 1) good.push_back(p.z() - kDistanceMm);
  EXPECT_GT(good.size(), model.size() * 9 / 10);
  EXPECT_LT(rmsOf(good), 0.45 * kSigmaMm);
}

}  // namespace
}  // namespace softscope::test
