// tests/calibrate/row_outlook_test.cpp: predicted errors of rows against those of calibrations by
// noisy corners.
#include "calibrate/row_outlook.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibrate/calibration_quality.h"
#include "rendered_boards.h"

namespace softscope::test {
namespace {

constexpr double kCornerSigmaPx = 0.011;  // that of the rendered boards (docs/calibrate.md)

/// As solveStereo() ends, begun at the truth, from corners with normally distributed errors.
CalibrationSolution solveNoisyCorners(const BoardRendering& r, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> error(0, kCornerSigmaPx);
  CalibrationSolution solution;
  BundleState& state = solution.state;
  state.left = r.truth.left;
  state.right = r.truth.right;
  state.right_from_left = r.truth.right_from_left;
  for (const Eigen::Isometry3d& pose : boardPoses(r, 20)) {
    BundleView view;
    view.left_from_board = pose;
    for (int id = 0; id < r.board.cornerCount(); ++id)
      for (const bool is_right : {false, true}) {
        Eigen::Vector3d p = pose * r.board.cornerPosition(id);
        if (is_right) p = r.truth.right_from_left * p;
        const RawCamera& camera = is_right ? r.truth.right : r.truth.left;
        const Eigen::Vector2d pixel = projectWithLens(camera, p, nullptr, nullptr);
        view.points.push_back({r.board.cornerPosition(id),
                               pixel + Eigen::Vector2d(error(random), error(random)), is_right});
      }
    state.views.push_back(view);
    solution.views.push_back({});
    solution.views.back().distance_mm = pose.translation().z();
  }
  solution.summary = adjustBundle({}, &state);
  return solution;
}

/// Rows of a point that the true cameras see, rectified by those found.
double rowErrorPx(const StereoCalibration& found, const StereoCalibration& truth,
                  const Eigen::Vector3d& point_mm) {
  const Eigen::Vector2d left = projectWithLens(truth.left, point_mm, nullptr, nullptr);
  const Eigen::Vector2d right =
      projectWithLens(truth.right, truth.right_from_left * point_mm, nullptr, nullptr);
  return rowDifferencesPx(found, {left}, {right})[0];
}

TEST(RowOutlook, ErrorsAreThePredictedOnesInTheMiddleAndAtTheRim) {
  constexpr int kSets = 40;
  BoardRendering r;
  r.truth = truthOfScope();
  r.board.square_mm = 3;
  const Eigen::Vector3d points_mm[] = {{0, 0, 70}, {35, 0, 70}, {40, 30, 70}, {-30, -30, 70}};
  double squares[4] = {};
  for (int set = 0; set < kSets; ++set) {
    r.seed = 200 + set;
    const CalibrationSolution solution = solveNoisyCorners(r, set);
    for (int i = 0; i < 4; ++i) {
      const double sigma_px = rowSigmaPx(solution, points_mm[i]);
      ASSERT_GT(sigma_px, 0);
      squares[i] +=
          std::pow(rowErrorPx(solution.calibration(), r.truth, points_mm[i]) / sigma_px, 2);
    }
  }
  for (int i = 0; i < 4; ++i) {  // chi-squared of 40: 18.3 to 73.4 but once in 1000
    EXPECT_GT(squares[i], 18) << i;
    EXPECT_LT(squares[i], 74) << i;
  }
}

TEST(RowOutlook, TheWorstPlaceIsACornerOfTheImageBeyondTheBoards) {
  BoardRendering r;
  r.truth = truthOfScope();
  r.board.square_mm = 3;
  const CalibrationSolution solution = solveNoisyCorners(r, 1);
  const RowOutlook outlook = rowOutlook(solution);
  EXPECT_GT(outlook.distance_mm, 40);
  EXPECT_GT(outlook.median_95_px, 0);
  EXPECT_GT(outlook.worst_95_px, 3 * outlook.median_95_px);
  EXPECT_GT(std::abs(outlook.worst_at_px.x() - 319.5), 250);
  EXPECT_GT(std::abs(outlook.worst_at_px.y() - 239.5), 180);
}

TEST(RowOutlook, WithoutViewsThereIsNone) {
  const RowOutlook outlook = rowOutlook(CalibrationSolution());
  EXPECT_TRUE(std::isnan(outlook.worst_95_px));
  EXPECT_TRUE(std::isnan(outlook.median_95_px));
}

}  // namespace
}  // namespace softscope::test
