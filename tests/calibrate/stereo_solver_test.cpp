// tests/calibrate/stereo_solver_test.cpp: rendered boards, solved, against the cameras that saw
// them.
#include "calibrate/stereo_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "calibrate/calibration_quality.h"
#include "core/error.h"
#include "core/parallel.h"
#include "rendered_boards.h"

namespace softscope::test {
namespace {

BoardRendering rendering(double scale, int seed) {
  BoardRendering rendering;
  rendering.truth = truthOfScope(scale);
  static const auto full_rays = raysOfScope(truthOfScope());
  if (scale == 1) rendering.rays = full_rays;
  rendering.board.square_mm = 3;
  rendering.seed = seed;
  return rendering;
}

CalibrationSolution solve(const BoardRendering& r, const std::vector<BoardSighting>& sightings) {
  return solveStereo(sightings, r.board, r.truth.left.pinhole.width_px,
                     r.truth.left.pinhole.height_px);
}

/// Pixels of points all over both images, 40 to 120 mm away, as the true cameras see them.
void truePairs(const StereoCalibration& truth, std::vector<Eigen::Vector2d>* left_px,
               std::vector<Eigen::Vector2d>* right_px) {
  const auto inside = [](const Eigen::Vector2d& p, const PinholeCamera& camera) {
    return p.x() >= 0 && p.y() >= 0 && p.x() < camera.width_px && p.y() < camera.height_px;
  };
  for (double z = 40; z <= 120; z += 20)
    for (double x = -0.6; x <= 0.6; x += 0.05)
      for (double y = -0.45; y <= 0.45; y += 0.05) {
        const Eigen::Vector3d p(x * z, y * z, z);
        const Eigen::Vector2d left = projectWithLens(truth.left, p, nullptr, nullptr);
        const Eigen::Vector2d right =
            projectWithLens(truth.right, truth.right_from_left * p, nullptr, nullptr);
        if (!inside(left, truth.left.pinhole) || !inside(right, truth.right.pinhole)) continue;
        left_px->push_back(left);
        right_px->push_back(right);
      }
}

TEST(StereoSolver, TwentyBlurredNoisyViewsGiveTheCameras) {
  const BoardRendering r = rendering(1, 7);
  const std::vector<BoardSighting> sightings = sightBoards(r, 20);
  ASSERT_GE(sightings.size(), 18u);
  const CalibrationSolution solution = solve(r, sightings);
  const StereoCalibration found = solution.calibration();
  for (const auto& [mine, truth] : {std::pair{found.left.pinhole, r.truth.left.pinhole},
                                    std::pair{found.right.pinhole, r.truth.right.pinhole}}) {
    EXPECT_NEAR(mine.fx_px / truth.fx_px, 1, 0.002);
    EXPECT_NEAR(mine.fy_px / truth.fy_px, 1, 0.002);
  }
  EXPECT_NEAR(found.baseline_mm() / r.truth.baseline_mm(), 1, 0.003);
  std::vector<Eigen::Vector2d> left_px, right_px;
  truePairs(r.truth, &left_px, &right_px);
  ASSERT_GT(left_px.size(), 1000u);
  std::vector<double> rows_px = rowDifferencesPx(found, left_px, right_px);
  for (double& row : rows_px) row = std::abs(row);
  std::sort(rows_px.begin(), rows_px.end());
  EXPECT_LT(rows_px[rows_px.size() * 95 / 100], 0.03);
  EXPECT_LT(rows_px.back(), 0.1);  // at the rim, beyond the boards' corners
  EXPECT_LT(solution.summary.rms_px, 0.05);
  const RowErrors rows = rowErrors(solution);
  EXPECT_LT(rows.worst_region_px, 0.05);
  EXPECT_GE(rows.rms_px, rows.worst_region_px);
}

TEST(StereoSolver, CharucoViewsGiveTheCameras) {
  BoardRendering r = rendering(1, 3);
  r.board.columns = 9;
  r.board.rows = 7;
  r.board.square_mm = 4;
  r.board.marker_mm = 3;
  const std::vector<BoardSighting> sightings = sightBoards(r, 20);
  ASSERT_GE(sightings.size(), 18u);
  const StereoCalibration found = solve(r, sightings).calibration();
  EXPECT_NEAR(found.left.pinhole.fx_px / r.truth.left.pinhole.fx_px, 1, 0.002);
  EXPECT_NEAR(found.baseline_mm() / r.truth.baseline_mm(), 1, 0.003);
}

std::vector<double> trueValues(const StereoCalibration& truth) {
  std::vector<double> values;
  for (const RawCamera& camera : {truth.left, truth.right}) {
    const auto& c = camera.distortion.coefficients;
    values.insert(values.end(), {camera.pinhole.fx_px, camera.pinhole.fy_px, camera.pinhole.cx_px,
                                 camera.pinhole.cy_px, c[0], c[1], c[2], c[3], c[4]});
  }
  const Eigen::AngleAxisd turn(truth.right_from_left.linear());
  for (int i = 0; i < 3; ++i) values.push_back(turn.angle() * turn.axis()[i] * 180 / M_PI);
  for (int i = 0; i < 3; ++i) values.push_back(truth.right_from_left.translation()[i]);
  values.push_back(truth.baseline_mm());
  return values;
}

#if defined(__has_feature)
#define SOFTSCOPE_SANITIZED __has_feature(address_sanitizer)
#else
#define SOFTSCOPE_SANITIZED 0
#endif
constexpr int kSets = SOFTSCOPE_SANITIZED ? 3 : 50;  // a set takes ten times as long there

TEST(StereoSolver, IntervalsOfNinetyFivePercentHoldTheTruthThatOften) {
  const auto rays = raysOfScope(truthOfScope(0.6));
  std::vector<std::vector<int>> inside(kSets);
  std::vector<std::string> names;
  for (int set = 0; set < kSets; ++set) {
    BoardRendering r = rendering(0.6, 100 + set);
    r.rays = rays;
    const CalibrationSolution solution = solve(r, sightBoards(r, 14));
    const std::vector<double> truth = trueValues(r.truth);
    const std::vector<ParameterInterval> intervals = parameterIntervals(solution);
    ASSERT_EQ(intervals.size(), truth.size());
    names.clear();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      inside[std::size_t(set)].push_back(std::abs(intervals[i].value - truth[i]) <=
                                         intervals[i].half_width);
      names.push_back(intervals[i].name);
    }
  }
  int all = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    int held = 0;
    for (const auto& set : inside) held += set[i];
    all += held;
    if (kSets == 50) {
      EXPECT_GE(held, 40) << names[i];  // of 50 draws of 95 %: once in 10 000
    }
  }
  const double share = double(all) / (double(names.size()) * kSets);
  RecordProperty("share_inside", std::to_string(share));
  if (kSets < 50) GTEST_SKIP() << "intervals are judged over 50 sets, here are " << kSets;
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.99);
}

TEST(StereoSolver, AViewThatDoesNotFitIsLeftOutAndNamed) {
  const BoardRendering r = rendering(1, 7);
  std::vector<BoardSighting> sightings = sightBoards(r, 12);
  for (std::size_t i = 0; i < sightings[3].right.size(); ++i)  // the views were not synchronous
    sightings[3].right[i].pixel += Eigen::Vector2d(6.0, 0.3 * double(i % 9));
  const CalibrationSolution solution = solve(r, sightings);
  ASSERT_EQ(solution.left_out.size(), 1u);
  EXPECT_EQ(solution.left_out[0].frame, sightings[3].frame);
  EXPECT_NE(solution.left_out[0].why.find("does not fit"), std::string::npos);
  EXPECT_NEAR(solution.calibration().left.pinhole.fx_px / r.truth.left.pinhole.fx_px, 1, 0.004);
}

TEST(StereoSolver, QualityNamesWhatIsMissing) {
  const BoardRendering r = rendering(1, 7);
  const std::vector<BoardSighting> sightings = sightBoards(r, 18);
  const CalibrationSolution good = solve(r, sightings);
  const BoardCoverage coverage = boardCoverage(good);
  EXPECT_GT(coverage.left_share, 0.6);
  const std::vector<BoardSighting> few(sightings.begin(), sightings.begin() + 6);
  const CalibrationSolution poor = solve(r, few);
  const auto advice = imagingAdvice(poor, boardCoverage(poor));
  EXPECT_TRUE(std::any_of(advice.begin(), advice.end(), [](const std::string& line) {
    return line.find("more views") != std::string::npos;
  }));
  EXPECT_GT(depthOutlook(poor, 80).bias_95_mm, depthOutlook(good, 80).bias_95_mm);
  // z^2 / (f B) * 0.25 px = 0.68 mm at 80 mm
  EXPECT_NEAR(depthOutlook(good, 80).sigma_mm, 80.0 * 80 / (566 * 4.2) * 0.25, 0.03);
  EXPECT_LT(depthOutlook(good, 80).bias_95_mm, 2);
}

TEST(StereoSolver, TooFewViewsAreRefused) {
  const BoardRendering r = rendering(1, 7);
  EXPECT_THROW(solve(r, {}), InputError);
  SolveOptions options;
  options.misfit_ratio = 1;
  EXPECT_THROW(options.validate(), OptionError);
}

}  // namespace
}  // namespace softscope::test
