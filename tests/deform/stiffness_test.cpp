// tests/deform/stiffness_test.cpp: tissue is as stiff as its deformation, compared with the noise
// of the matches, allows.
#include "deform/energy/stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "deform/graph/warp.h"
#include "deform/solver/lm_solver.h"
#include "scenes.h"

namespace softscope {
namespace {

constexpr double kPerAxis = 0.1;  // standard error of matches, mm

/// Matches of the hill, moved by `truth`, with noise; every `wrong`-th lies 4 mm aside (0: none).
struct MatchedHill {
  PointModel model = scenes::makeHill(60, 50, 0.4);
  WarpGraph graph = scenes::bindGraph(&model);
  MatchedStrain strain;

  explicit MatchedHill(const scenes::Motion& truth, double noise_share, int wrong = 0) {
    std::vector<KeyPointMatch> matches = scenes::makeMatches(model, truth, 2);
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, static_cast<float>(kPerAxis));
    int at = 0;
    for (KeyPointMatch& match : matches) {
      const Eigen::Vector3f error_mm(noise(random), noise(random), noise(random));
      match.target_mm += static_cast<float>(noise_share) * error_mm;
      if (wrong > 0 && ++at % wrong == 0) match.target_mm += 4 * error_mm.normalized();
    }
    strain = strainOfMatches(model, graph, CarriedMatches(model, graph, matches));
  }
};

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double meanStrain(const MatchedHill& hill) { return meanOf(hill.strain.edges_square); }
double meanStiffness(const MatchedHill& hill) { return meanOf(stiffnessOf(hill.strain)); }

/// So many edges with this strain.
MatchedStrain strainOf(double edges_square, double noise_square, int edges) {
  return {std::vector<double>(static_cast<std::size_t>(edges), edges_square), noise_square, edges};
}

Eigen::Vector3d staysInPlace(const Eigen::Vector3d& point_mm) { return point_mm; }

TEST(Stiffness, NoiseOfMatchesIsNoStrain) {
  const MatchedHill hill(staysInPlace, 1);
  EXPECT_GT(hill.strain.edges, 20);
  EXPECT_EQ(hill.strain.edges_square.size(), hill.graph.edges.size());
  EXPECT_NEAR(hill.strain.noise_square, 3 * kPerAxis * kPerAxis, 0.3 * 3 * kPerAxis * kPerAxis);
  EXPECT_NEAR(meanStrain(hill), 0, 0.1 * hill.strain.noise_square);
  EXPECT_GT(meanStiffness(hill), 0.98);
}

TEST(Stiffness, AShiftIsNoStrain) {
  EXPECT_GT(meanStiffness(MatchedHill(scenes::shift({1, 0.5, -0.5}), 1)), 0.98);
}

TEST(Stiffness, AFifthOfWrongMatchesIsNoStrain) {
  EXPECT_GT(meanStiffness(MatchedHill(staysInPlace, 1, 5)), 0.9);
}

TEST(Stiffness, IsLessWhereMatchesBendTogether) {
  const MatchedHill exact(scenes::smoothBend, 0), noisy(scenes::smoothBend, 0.5);
  EXPECT_LT(meanStiffness(exact), meanStiffness(noisy));
  EXPECT_NEAR(meanStrain(noisy), meanStrain(exact), 0.5 * meanStrain(exact));
}

/// A fold to one side of x = 0; the other side does not move.
Eigen::Vector3d foldsOnOneSide(const Eigen::Vector3d& point_mm) {
  return point_mm - Eigen::Vector3d(0, 0, 0.3 * std::max(point_mm.x(), 0.0));
}

TEST(Stiffness, StaysWhereTissueIsStill) {
  const MatchedHill hill(foldsOnOneSide, 1);
  const std::vector<double> factors = stiffnessOf(hill.strain);
  std::vector<double> of_folded, of_still;
  for (std::size_t e = 0; e < factors.size(); ++e) {
    const GraphEdge& edge = hill.graph.edges[e];
    const double x =
        0.5 * (hill.graph.positions_mm[edge.first].x() + hill.graph.positions_mm[edge.second].x());
    if (x > 4) of_folded.push_back(factors[e]);
    if (x < -4) of_still.push_back(factors[e]);
  }
  EXPECT_LT(meanOf(of_folded), 0.1);
  EXPECT_GT(meanOf(of_still), 0.8);
}

// docs/energy.md (7c): half of it at 2.5 times the square of the noise.
TEST(Stiffness, FallsWithTheSquareOfTheRatio) {
  EXPECT_DOUBLE_EQ(stiffnessOf(strainOf(2.5 * 0.3, 0.3, 99))[7], 0.5);
  EXPECT_DOUBLE_EQ(stiffnessOf(strainOf(5 * 0.3, 0.3, 99))[7], 0.2);
  EXPECT_EQ(stiffnessOf(strainOf(-0.1, 0.3, 99))[7], 1);
}

TEST(Stiffness, FewMatchesOrEdgesSayNothing) {
  EXPECT_TRUE(stiffnessOf({}).empty());
  EXPECT_EQ(stiffnessOf(strainOf(10, 0.3, 19))[7], 1);
  PointModel model = scenes::makeHill(20, 16, 0.5);
  const WarpGraph graph = scenes::bindGraph(&model);
  const std::vector<KeyPointMatch> none;
  EXPECT_EQ(strainOfMatches(model, graph, CarriedMatches(model, graph, none)).edges, 0);
}

TEST(Stiffness, IsBounded) {
  EXPECT_EQ(stiffnessOf(strainOf(100, 0.1, 99))[7], 1.0 / 64);
  EXPECT_EQ(stiffnessOf(strainOf(1, 0, 99))[7], 1.0 / 64);
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
