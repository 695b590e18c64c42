// tests/deform/stiffness_test.cpp: tissue is as stiff as its deformation, compared with the noise
// of the matches, allows.
#include "deform/energy/stiffness.h"

#include <gtest/gtest.h>

#include <random>

#include "deform/graph/warp.h"
#include "deform/solver/lm_solver.h"
#include "scenes.h"

namespace softscope {
namespace {

constexpr double kPerAxis = 0.1;  // standard error of matches, mm

/// Matches of the hill, moved by `truth`, with noise; every `wrong`-th lies 4 mm aside (0: none).
MatchedStrain strainAfter(const scenes::Motion& truth, double noise_share, int wrong = 0) {
  PointModel model = scenes::makeHill(60, 50, 0.4);
  const WarpGraph graph = scenes::bindGraph(&model);
  std::vector<KeyPointMatch> matches = scenes::makeMatches(model, truth, 2);
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, static_cast<float>(kPerAxis));
  int at = 0;
  for (KeyPointMatch& match : matches) {
    const Eigen::Vector3f error_mm(noise(random), noise(random), noise(random));
    match.target_mm += static_cast<float>(noise_share) * error_mm;
    if (wrong > 0 && ++at % wrong == 0) match.target_mm += 4 * error_mm.normalized();
  }
  return strainOfMatches(graph, CarriedMatches(model, graph, matches));
}

Eigen::Vector3d staysInPlace(const Eigen::Vector3d& point_mm) { return point_mm; }

TEST(Stiffness, NoiseOfMatchesIsNoStrain) {
  const MatchedStrain strain = strainAfter(staysInPlace, 1);
  EXPECT_GT(strain.edges, 20);
  EXPECT_NEAR(strain.noise_square, 3 * kPerAxis * kPerAxis, 0.3 * 3 * kPerAxis * kPerAxis);
  EXPECT_NEAR(strain.edges_square, 0, 0.1 * strain.noise_square);
  EXPECT_GT(stiffnessOf(strain), 0.98);
}

TEST(Stiffness, AShiftIsNoStrain) {
  EXPECT_GT(stiffnessOf(strainAfter(scenes::shift({1, 0.5, -0.5}), 1)), 0.98);
}

TEST(Stiffness, AFifthOfWrongMatchesIsNoStrain) {
  EXPECT_GT(stiffnessOf(strainAfter(staysInPlace, 1, 5)), 0.9);
}

TEST(Stiffness, IsLessWhereMatchesBendTogether) {
  const MatchedStrain exact = strainAfter(scenes::smoothBend, 0);
  const MatchedStrain noisy = strainAfter(scenes::smoothBend, 0.5);
  EXPECT_LT(stiffnessOf(exact), stiffnessOf(noisy));
  EXPECT_NEAR(noisy.edges_square, exact.edges_square, 0.5 * exact.edges_square);
}

// docs/energy.md (7c): half of it at 2.5 times the square of the noise.
TEST(Stiffness, FallsWithTheSquareOfTheRatio) {
  EXPECT_DOUBLE_EQ(stiffnessOf({2.5 * 0.3, 0.3, 99}), 0.5);
  EXPECT_DOUBLE_EQ(stiffnessOf({5 * 0.3, 0.3, 99}), 0.2);
  EXPECT_EQ(stiffnessOf({-0.1, 0.3, 99}), 1);
}

TEST(Stiffness, FewMatchesOrEdgesSayNothing) {
  EXPECT_EQ(stiffnessOf({}), 1);
  EXPECT_EQ(stiffnessOf({10, 0.3, 19}), 1);
  PointModel model = scenes::makeHill(20, 16, 0.5);
  const WarpGraph graph = scenes::bindGraph(&model);
  const std::vector<KeyPointMatch> none;
  EXPECT_EQ(strainOfMatches(graph, CarriedMatches(model, graph, none)).edges, 0);
}

TEST(Stiffness, IsBounded) {
  EXPECT_EQ(stiffnessOf({100, 0.1, 99}), 1.0 / 64);
  EXPECT_EQ(stiffnessOf({1, 0, 99}), 1.0 / 64);
}

TEST(Stiffness, IsOneIfOptionsDoNotFollowTheTissue) {
  PointModel model = scenes::makeHill(60, 50, 0.4);
  const WarpGraph graph = scenes::bindGraph(&model);
  const std::vector<KeyPointMatch> matches = scenes::makeMatches(model, scenes::smoothBend, 2);
  const CarriedMatches carried(model, graph, matches);
  DeformOptions options;
  EXPECT_LT(tissueStiffness(options, graph, carried), 0.1);
  options.solver.follows_tissue = false;
  EXPECT_EQ(tissueStiffness(options, graph, carried), 1);
}

/// Mean error after one frame whose matches are wrong by `sigma_mm` per axis.
double errorAfter(const scenes::Motion& truth, double sigma_mm, bool follows_tissue) {
  PointModel model = scenes::makeHill(40, 30, 0.5);
  WarpGraph graph = scenes::bindGraph(&model);
  DeformObservation seen;
  seen.matches = scenes::makeMatches(model, truth, 8);
  std::mt19937 random(5);
  std::normal_distribution<float> noise;
  const auto sigma = static_cast<float>(sigma_mm);
  for (KeyPointMatch& match : seen.matches)
    match.target_mm += sigma * Eigen::Vector3f(noise(random), noise(random), noise(random));
  DeformOptions options;
  options.solver.follows_tissue = follows_tissue;
  const auto view = scenes::renderHill(scenes::makeCamera(160, 130, 225), truth, 44, 34);
  const DepthTarget target(view.depth, view.normals, view.camera, Eigen::Isometry3d::Identity(),
                           options.association);
  seen.surface = &target;
  makeDeformSolver(options)->solve(model, seen, &graph);
  PointModel warped = model;
  warpModel(graph, &warped);
  return scenes::meanError(model, warped, truth);
}

TEST(Stiffness, ExactMatchesBendTheTissue) {
  EXPECT_LT(errorAfter(scenes::smoothBend, 0, true),
            0.6 * errorAfter(scenes::smoothBend, 0, false));
}

TEST(Stiffness, NoisyMatchesOfRigidTissueDoNot) {
  const scenes::Motion rigid = scenes::shift({1, 0.5, -0.5});
  EXPECT_LT(errorAfter(rigid, 0.3, true), 1.1 * errorAfter(rigid, 0.3, false));
}

}  // namespace
}  // namespace softscope
