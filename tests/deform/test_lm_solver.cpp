// tests/deform/test_lm_solver.cpp: known motions come back.
#include <gtest/gtest.h>

#include <random>

#include "core/parallel.h"
#include "deform/graph/warp.h"
#include "deform/solver/lm_solver.h"
#include "scenes.h"

namespace softscope {
namespace {

DeformOptions optionsFor(NodeModel model) {
  DeformOptions options = model == NodeModel::kAffine ? DeformOptions::paper() : DeformOptions();
  options.node_model = model;
  options.regularisation_weight = 10;
  options.solver.follows_tissue = false;
  options.rest_weight = 0;  // the exact answers below are those of tissue that nothing holds
  options.correspondence_weight = 10;
  options.data_robust.loss = options.correspondence_robust.loss = RobustLoss::kNone;
  options.solver.max_iterations = 30;
  options.solver.step_tolerance_mm = 1e-6;
  options.solver.cost_tolerance = 1e-9;
  return options;
}

void expectMonotone(const DeformSummary& summary) {
  ASSERT_EQ(summary.costs.size(), 2 * static_cast<std::size_t>(summary.iterations));
  for (std::size_t i = 0; i < summary.costs.size(); i += 2)
    EXPECT_LT(summary.costs[i + 1], summary.costs[i]);
}

class BothNodeModels : public ::testing::TestWithParam<NodeModel> {};

TEST_P(BothNodeModels, RecoverARigidMotionFromMatches) {
  PointModel model = scenes::makeHill(30, 24, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  const scenes::Motion truth = [&](const Eigen::Vector3d& p) { return motion * p; };
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, truth, 20);

  const DeformSummary summary =
      makeDeformSolver(optionsFor(GetParam()))->solve(model, seen, &graph);

  EXPECT_TRUE(summary.converged()) << toString(summary.reason);
  expectMonotone(summary);
  PointModel warped = model;
  warpModel(graph, &warped);
  EXPECT_LT(scenes::meanError(model, warped, truth), 2e-5);  // float coordinates of 60 mm
  for (const NodeTransform& transform : graph.transforms)
    EXPECT_LT((transform.linear - motion.linear()).norm(), 1e-4);
}

TEST_P(BothNodeModels, RecoverARigidMotionFromDepthAndMatches) {
  PointModel model = scenes::makeHill(30, 24, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  const scenes::Motion truth = [&](const Eigen::Vector3d& p) { return motion * p; };
  const auto view = scenes::renderHill(scenes::makeCamera(320, 260, 600), truth, 34, 28);
  const DeformOptions options = optionsFor(GetParam());
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  DeformObservation seen;
  seen.surface = &target;
  seen.matches = scenes::makeMatches(model, truth, 50);

  const DeformSummary summary = makeDeformSolver(options)->solve(model, seen, &graph);

  expectMonotone(summary);
  EXPECT_TRUE(summary.warnings.empty());
  EXPECT_GT(summary.pivot_ratio, 1e-3);
  EXPECT_GT(summary.points_after, 2000);
  PointModel warped = model;
  warpModel(graph, &warped);
  // A plane per pixel of 0.1 mm leaves 0.05² / 2 of the curvature's 1 / 20 mm.
  EXPECT_LT(scenes::meanError(model, warped, truth), 1e-3);
  EXPECT_LT(summary.data_mean_mm_after, 5e-4);
  EXPECT_GT(summary.data_mean_mm_before, 0.2);
}

TEST_P(BothNodeModels, RecoverASmoothBend) {
  PointModel model = scenes::makeHill(40, 30, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const auto view =
      scenes::renderHill(scenes::makeCamera(320, 260, 450), scenes::smoothBend, 44, 34);
  DeformOptions options = optionsFor(GetParam());
  options.rotation_weight = 10;
  options.regularisation_weight = 0.1;
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  DeformObservation seen;
  seen.surface = &target;
  seen.matches = scenes::makeMatches(model, scenes::smoothBend, 20);

  const DeformSummary summary = makeDeformSolver(options)->solve(model, seen, &graph);

  expectMonotone(summary);
  PointModel warped = model;
  warpModel(graph, &warped);
  const double unmoved = scenes::meanError(model, model, scenes::smoothBend);
  EXPECT_GT(unmoved, 0.8);
  EXPECT_LT(scenes::meanError(model, warped, scenes::smoothBend), 0.03);  // a 4 mm graph's limit
}

TEST_P(BothNodeModels, LetTheUnseenPartFollowAsRigidlyAsPossible) {
  PointModel model = scenes::makeHill(40, 20, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  const scenes::Motion truth = [&](const Eigen::Vector3d& p) { return motion * p; };
  DeformObservation seen;  // matches on the left third only
  for (const KeyPointMatch& match : scenes::makeMatches(model, truth, 5))
    if (match.source_mm.x() < -7) seen.matches.push_back(match);

  const DeformSummary summary =
      makeDeformSolver(optionsFor(GetParam()))->solve(model, seen, &graph);

  EXPECT_GT(summary.nodes_without_data, static_cast<int>(graph.size()) / 3);
  EXPECT_EQ(summary.components_without_data, 0);
  PointModel warped = model;
  warpModel(graph, &warped);
  EXPECT_LT(scenes::meanError(model, warped, truth), 1e-3);  // a rigid whole costs nothing
}

// What holds hidden tissue in place must not hold it back from following what is seen: two thirds
// of the hill are hidden, and lag by less than a fiftieth of the motion.
TEST_P(BothNodeModels, HoldHiddenTissueLooselyAndLessWhereItIsPulled) {
  const PointModel hill = scenes::makeHill(40, 20, 0.5);
  const scenes::Motion truth = scenes::shift({1, 0.5, -0.5});
  DeformObservation seen;
  for (const KeyPointMatch& match : scenes::makeMatches(hill, truth, 5))
    if (match.source_mm.x() < -7) seen.matches.push_back(match);
  double before_mm = 0;
  for (const double rest_weight : {0.005, 0.05, 0.5}) {
    PointModel model = hill;
    WarpGraph graph = scenes::bindGraph(&model);
    DeformOptions options = optionsFor(GetParam());
    options.regularisation_weight = DeformOptions().regularisation_weight;
    options.rest_weight = rest_weight;
    makeDeformSolver(options)->solve(model, seen, &graph);
    PointModel warped = model;
    warpModel(graph, &warped);
    const double lag_mm = scenes::meanError(model, warped, truth);
    EXPECT_GT(lag_mm, before_mm);
    if (rest_weight == DeformOptions().rest_weight) {
      EXPECT_LT(lag_mm, 0.02 * 1.23);  // of 1.23 mm
    }
    before_mm = lag_mm;
  }
}

TEST_P(BothNodeModels, GiveTheSameBytesOnAnyNumberOfThreads) {
  PointModel model = scenes::makeHill(50, 40, 0.5);
  const WarpGraph start = scenes::bindGraph(&model);
  const auto view =
      scenes::renderHill(scenes::makeCamera(160, 130, 180), scenes::smoothBend, 54, 44);
  const DeformOptions options = optionsFor(GetParam());
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  DeformObservation seen;
  seen.surface = &target;
  seen.matches = scenes::makeMatches(model, scenes::smoothBend, 40);
  std::vector<WarpGraph> found;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    found.push_back(start);
    makeDeformSolver(options)->solve(model, seen, &found.back());
  }
  for (std::size_t j = 0; j < start.size(); ++j)
    for (std::size_t other : {1, 2}) {
      ASSERT_EQ(found[0].transforms[j].linear, found[other].transforms[j].linear);
      ASSERT_EQ(found[0].transforms[j].translation_mm, found[other].transforms[j].translation_mm);
    }
}

TEST_P(BothNodeModels, ASolverThatIsUsedAgainForgetsTheLastGraph) {
  const auto solver = makeDeformSolver(optionsFor(GetParam()));
  for (const double width_mm : {30.0, 18.0, 30.0}) {
    PointModel model = scenes::makeHill(width_mm, 20, 0.5);
    WarpGraph graph = scenes::bindGraph(&model), fresh = graph;
    DeformObservation seen;
    seen.matches = scenes::makeMatches(model, scenes::smoothBend, 20);
    solver->solve(model, seen, &graph);
    makeDeformSolver(optionsFor(GetParam()))->solve(model, seen, &fresh);
    for (std::size_t j = 0; j < graph.size(); ++j)
      ASSERT_EQ(graph.transforms[j].translation_mm, fresh.transforms[j].translation_mm);
  }
}

TEST_P(BothNodeModels, StopBeforeAStepThatWouldGainNothing) {
  PointModel model = scenes::makeHill(30, 24, 0.5);
  const WarpGraph start = scenes::bindGraph(&model);
  const auto view =
      scenes::renderHill(scenes::makeCamera(320, 260, 600), scenes::smoothBend, 34, 28);
  DeformOptions options = optionsFor(GetParam());
  options.solver.step_tolerance_mm = 0;
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  DeformObservation seen;
  seen.surface = &target;
  seen.matches = scenes::makeMatches(model, scenes::smoothBend, 50);
  const auto solve = [&](double cost_tolerance) {
    options.solver.cost_tolerance = cost_tolerance;
    WarpGraph graph = start;
    return makeDeformSolver(options)->solve(model, seen, &graph);
  };

  const DeformSummary patient = solve(1e-9), usual = solve(1e-3);

  EXPECT_TRUE(usual.converged()) << toString(usual.reason);
  EXPECT_LT(usual.iterations, patient.iterations);
  EXPECT_LT(usual.after.total(), patient.after.total() * (1 + 2e-3));
  const std::vector<double>& costs = usual.costs;  // the last step still gained more than the limit
  EXPECT_GT(costs[costs.size() - 2] - costs.back(), 1e-3 * costs[costs.size() - 2]);
}

INSTANTIATE_TEST_SUITE_P(RigidAndAffine, BothNodeModels,
                         ::testing::Values(NodeModel::kRigid, NodeModel::kAffine));

TEST(RobustSolve, WrongMatchesHaveABoundedPull) {
  PointModel model = scenes::makeHill(30, 24, 0.5);
  const WarpGraph start = scenes::bindGraph(&model);
  const Eigen::Isometry3d motion = scenes::rigidMotion();
  const scenes::Motion truth = [&](const Eigen::Vector3d& p) { return motion * p; };
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, truth, 20);
  for (std::size_t i = 0; i < seen.matches.size(); i += 10)
    seen.matches[i].target_mm += Eigen::Vector3f(4, 3, 0);
  double errors[2];
  for (const RobustLoss loss : {RobustLoss::kNone, RobustLoss::kHuber}) {
    DeformOptions options = optionsFor(NodeModel::kRigid);
    options.correspondence_robust = {loss, 0.05};  // the scale bounds what a wrong match pulls
    WarpGraph graph = start;
    const DeformSummary summary = makeDeformSolver(options)->solve(model, seen, &graph);
    expectMonotone(summary);
    PointModel warped = model;
    warpModel(graph, &warped);
    errors[loss == RobustLoss::kHuber] = scenes::meanError(model, warped, truth);
  }
  EXPECT_GT(errors[0], 0.3);  // a tenth of the matches is 5 mm off
  EXPECT_LT(errors[1], 0.01);
}

// What a first step cannot explain is noise, and another step cannot either; a step that explains
// most of the cost was long, and another one corrects what is not linear in it.
TEST(FirstStep, IsEnoughWhereItLeavesNoise) {
  PointModel model = scenes::makeHill(30, 24, 0.5);
  const WarpGraph start = scenes::bindGraph(&model);
  std::mt19937 random(5);
  const auto noise_mm = [&] { return 1e-9F * static_cast<float>(random()) - 2.1F; };
  const auto solve = [&](double share_of_bend, bool after_gap = false) {
    const scenes::Motion motion = [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(p + share_of_bend * (scenes::smoothBend(p) - p));
    };
    DeformObservation seen;
    seen.after_gap = after_gap;
    seen.matches = scenes::makeMatches(model, motion, 20);
    for (KeyPointMatch& match : seen.matches)
      match.target_mm += 0.1F * Eigen::Vector3f(noise_mm(), noise_mm(), noise_mm());
    WarpGraph graph = start;
    return makeDeformSolver(optionsFor(NodeModel::kRigid))->solve(model, seen, &graph);
  };
  const DeformSummary still = solve(0.05), bent = solve(1);
  EXPECT_EQ(still.iterations, 1);
  EXPECT_TRUE(still.converged()) << toString(still.reason);
  EXPECT_GT(still.costs[1], 0.5 * still.costs[0]);
  EXPECT_GT(bent.iterations, 1);
  EXPECT_GT(solve(0.05, /*after_gap=*/true).iterations, 1);  // it may have moved far
  EXPECT_LT(bent.costs[1], 0.5 * bent.costs[0]);
}

TEST(SubsampledSolve, FindsNearlyTheSameWarp) {
  PointModel model = scenes::makeHill(40, 30, 0.25);
  const WarpGraph start = scenes::bindGraph(&model);
  const auto view =
      scenes::renderHill(scenes::makeCamera(320, 260, 450), scenes::smoothBend, 44, 34);
  std::vector<PointModel> warped;
  for (const int max_points : {0, 4000}) {
    DeformOptions options = optionsFor(NodeModel::kRigid);
    options.association.max_points = max_points;
    const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                             options.association);
    DeformObservation seen;
    seen.surface = &target;
    seen.matches = scenes::makeMatches(model, scenes::smoothBend, 100);
    WarpGraph graph = start;
    const DeformSummary summary = makeDeformSolver(options)->solve(model, seen, &graph);
    EXPECT_LE(summary.points_after, max_points == 0 ? 1 << 30 : max_points);
    warped.push_back(model);
    warpModel(graph, &warped.back());
  }
  double sum = 0;
  for (std::size_t i = 0; i < model.size(); ++i)
    sum += (warped[0].positions_mm[i] - warped[1].positions_mm[i]).norm();
  EXPECT_LT(sum / static_cast<double>(model.size()), 0.02);  // a tenth of a pixel
}

}  // namespace
}  // namespace softscope
