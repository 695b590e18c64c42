// tests/calibrate/bundle_test.cpp: derivatives, and noise whose effect is predicted.
#include "calibrate/bundle.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "core/error.h"
#include "rendered_boards.h"

namespace softscope::test {
namespace {

BundleState exactState(int views) {
  BoardRendering rendering;
  rendering.truth = truthOfScope();
  rendering.board.square_mm = 3;
  BundleState state{
      rendering.truth.left, rendering.truth.right, rendering.truth.right_from_left, {}};
  for (const Eigen::Isometry3d& pose : boardPoses(rendering, views)) {
    BundleView view;
    view.left_from_board = pose;
    for (int id = 0; id < rendering.board.cornerCount(); ++id)
      for (const bool is_right : {false, true}) {
        const Eigen::Vector3d board_mm = rendering.board.cornerPosition(id);
        const Eigen::Vector3d p = pose * board_mm;
        view.points.push_back({board_mm, projectThroughRig(state, p, is_right).pixel, is_right});
      }
    state.views.push_back(view);
  }
  return state;
}

void addNoise(double sigma_px, unsigned seed, BundleState* state) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, sigma_px);
  for (BundleView& view : state->views)
    for (BundlePoint& point : view.points)
      point.pixel += Eigen::Vector2d(noise(random), noise(random));
}

TEST(Bundle, ProjectsAsOpenCvDoes) {
  const RawCamera camera = truthOfScope().left;
  const Eigen::Vector3d p(9, -6, 60);
  cv::Mat k = (cv::Mat_<double>(3, 3) << camera.pinhole.fx_px, 0, camera.pinhole.cx_px, 0,
               camera.pinhole.fy_px, camera.pinhole.cy_px, 0, 0, 1);
  std::vector<double> d(camera.distortion.coefficients.begin(),
                        camera.distortion.coefficients.begin() + 5);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(), k, d,
                    pixels);
  const Eigen::Vector2d pixel = projectWithLens(camera, p, nullptr, nullptr);
  EXPECT_NEAR(pixel.x(), pixels[0].x, 1e-10);
  EXPECT_NEAR(pixel.y(), pixels[0].y, 1e-10);
}

/// The state with the shared unknown `which` larger by `step`.
BundleState moved(BundleState state, int which, double step) {
  if (which < 2 * kCameraUnknowns) {
    RawCamera& camera = which < kCameraUnknowns ? state.left : state.right;
    PinholeCamera& pinhole = camera.pinhole;
    double* const values[] = {&pinhole.fx_px, &pinhole.fy_px, &pinhole.cx_px, &pinhole.cy_px};
    const int own = which % kCameraUnknowns;
    (own < 4 ? *values[own] : camera.distortion.coefficients[std::size_t(own - 4)]) += step;
  } else if (which < 2 * kCameraUnknowns + 3) {
    Eigen::Vector3d axis = Eigen::Vector3d::Unit(which - 2 * kCameraUnknowns);
    state.right_from_left.linear() =
        Eigen::AngleAxisd(step, axis).toRotationMatrix() * state.right_from_left.linear();
  } else {
    state.right_from_left.translation()[which - 2 * kCameraUnknowns - 3] += step;
  }
  return state;
}

TEST(Bundle, DerivativesAreThoseOfDifferences) {
  const BundleState state = exactState(1);
  const Eigen::Vector3d p(9, -6, 60);
  for (const bool is_right : {false, true}) {
    const RigProjection seen = projectThroughRig(state, p, is_right);
    for (int i = 0; i < kRigUnknowns; ++i) {
      const double step = 1e-5;
      const Eigen::Vector2d slope = (projectThroughRig(moved(state, i, step), p, is_right).pixel -
                                     projectThroughRig(moved(state, i, -step), p, is_right).pixel) /
                                    (2 * step);
      EXPECT_LT((seen.by_rig.col(i) - slope).norm(), 1e-5 * (1 + slope.norm())) << i;
    }
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(i);
      const Eigen::Vector2d slope = (projectThroughRig(state, p + step, is_right).pixel -
                                     projectThroughRig(state, p - step, is_right).pixel) /
                                    2e-5;
      EXPECT_LT((seen.by_left_point.col(i) - slope).norm(), 1e-5 * (1 + slope.norm()));
    }
  }
}

TEST(Bundle, ExactCornersGiveTheExactCameras) {
  BundleState state = exactState(8);
  const BundleState truth = state;
  for (int i = 0; i < 4; ++i) state = moved(state, i, 3);
  state = moved(state, 2 * kCameraUnknowns + 5, 0.2);
  const BundleSummary summary = adjustBundle({}, &state);
  EXPECT_TRUE(summary.converged);
  EXPECT_LT(summary.rms_px, 1e-6);
  EXPECT_NEAR(state.left.pinhole.fx_px, truth.left.pinhole.fx_px, 1e-4);
  EXPECT_NEAR(state.right_from_left.translation().x(), -4.2, 1e-6);
}

TEST(Bundle, NoiseIsMeasuredAndItsEffectPredicted) {
  const BundleState exact = exactState(12);
  double squares = 0, sigma = 0;
  const int sets = 40;
  double predicted = 0;
  for (int set = 0; set < sets; ++set) {
    BundleState state = exact;
    addNoise(0.1, unsigned(set + 1), &state);
    const BundleSummary summary = adjustBundle({}, &state);
    squares += std::pow(state.left.pinhole.fx_px - exact.left.pinhole.fx_px, 2);
    sigma += summary.sigma_px / sets;
    predicted += summary.covariance(0, 0) / sets;
  }
  EXPECT_NEAR(sigma, 0.1, 0.002);
  EXPECT_NEAR(std::sqrt(squares / sets / predicted), 1, 0.25);  // of 40 draws: 1 -+ 0.11
}

TEST(Bundle, AFixedCoefficientStaysAndHasNoVariance) {
  BundleState state = exactState(6);
  state.left.distortion.coefficients[4] = 0;
  BundleOptions options;
  options.lens_coefficients = 4;
  const BundleSummary summary = adjustBundle(options, &state);
  EXPECT_EQ(state.left.distortion.coefficients[4], 0);
  EXPECT_EQ(summary.covariance(8, 8), 0);
  EXPECT_GT(summary.covariance(7, 7), 0);
  options.lens_coefficients = 3;
  EXPECT_THROW(options.validate(), OptionError);
}

TEST(Bundle, AlikeViewsDoNotDetermineTheCameras) {
  BundleState state = exactState(3);
  for (BundleView& view : state.views) {
    view.left_from_board.linear().setIdentity();
    view.left_from_board.translation() = Eigen::Vector3d(-12, -7, 60);
    for (BundlePoint& point : view.points)
      point.pixel =
          projectThroughRig(state, view.left_from_board * point.board_mm, point.is_right).pixel;
  }
  EXPECT_THROW(adjustBundle({}, &state), InputError);
}

}  // namespace
}  // namespace softscope::test
