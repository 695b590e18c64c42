#include "calibrate/row_outlook.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <optional>

namespace softscope {
namespace {

constexpr double kTwoSided95 = 1.959964;  // in sigmas of a normal distribution
constexpr int kAcross = 17, kDown = 13;   // grid size, including corners
constexpr double kSamePixel = 0.01;

/// Viewing direction (z = 1) of a pixel; none if the lens model is not invertible there.
std::optional<Eigen::Vector3d> directionAt(const RawCamera& camera, const Eigen::Vector2d& pixel) {
  cv::Mat k;
  cv::eigen2cv(camera.pinhole.matrix(), k);
  const cv::Mat lens(1, 5, CV_64F, const_cast<double*>(camera.distortion.coefficients.data()));
  std::vector<cv::Point2d> raw{{pixel.x(), pixel.y()}}, found;
  cv::undistortPoints(raw, found, k, lens, cv::noArray(), cv::noArray(),
                      {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10});
  const Eigen::Vector3d direction(found[0].x, found[0].y, 1);
  const Eigen::Vector2d seen = projectWithLens(camera, direction, nullptr, nullptr);
  if (!((seen - pixel).norm() < kSamePixel)) return std::nullopt;
  return direction;
}

bool isVisibleToRight(const BundleState& state, const Eigen::Vector3d& point_left_mm) {
  const Eigen::Vector3d point_mm = state.right_from_left * point_left_mm;
  if (point_mm.z() <= 0) return false;
  const Eigen::Vector2d pixel = projectWithLens(state.right, point_mm, nullptr, nullptr);
  const PinholeCamera& camera = state.right.pinhole;
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.width_px - 1 &&
         pixel.y() <= camera.height_px - 1;
}

double middleOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double rowSigmaPx(const CalibrationSolution& solution, const Eigen::Vector3d& point_left_mm) {
  const BundleState& state = solution.state;
  const RigProjection left = projectThroughRig(state, point_left_mm, false);
  const RigProjection right = projectThroughRig(state, point_left_mm, true);
  // With a fixed left pixel, an error of the unknowns moves the point, and with it the right pixel.
  const Eigen::Matrix<double, 2, 3>& by_point = left.by_left_point;
  const Eigen::Matrix<double, 3, 2> point_by_pixel =
      by_point.transpose() * (by_point * by_point.transpose()).inverse();
  const Eigen::Matrix<double, 2, kRigUnknowns> right_by_rig =
      right.by_rig - right.by_left_point * point_by_pixel * left.by_rig;
  // Without the right lens; only the component across the epipolar line is a vertical disparity.
  const Eigen::Vector3d point_right_mm = state.right_from_left * point_left_mm;
  Eigen::Matrix<double, 2, 3> bend;
  projectWithLens(state.right, point_right_mm / point_right_mm.z(), &bend, nullptr);
  const Eigen::Matrix2d unbend = bend.leftCols<2>().inverse();
  const Eigen::Vector2d along = (unbend * right.by_left_point * point_left_mm).normalized();
  const Eigen::Matrix<double, 1, kRigUnknowns> row_by_rig =
      state.left.pinhole.fy_px * Eigen::RowVector2d(-along.y(), along.x()) * unbend * right_by_rig;
  const double variance = (row_by_rig * solution.summary.covariance * row_by_rig.transpose())(0, 0);
  return std::sqrt(std::max(0.0, variance));
}

RowOutlook rowOutlook(const CalibrationSolution& solution) {
  RowOutlook outlook;
  std::vector<double> distances_mm, sigmas_px;
  for (const SolvedView& view : solution.views) distances_mm.push_back(view.distance_mm);
  outlook.distance_mm = middleOf(distances_mm);
  const RawCamera& left = solution.state.left;
  double worst_px = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < kAcross * kDown; ++i) {
    const Eigen::Vector2d pixel((left.pinhole.width_px - 1.0) * (i % kAcross) / (kAcross - 1),
                                (left.pinhole.height_px - 1.0) * (i / kAcross) / (kDown - 1));
    const std::optional<Eigen::Vector3d> direction = directionAt(left, pixel);
    if (!direction) continue;
    const Eigen::Vector3d point_mm = *direction * outlook.distance_mm;
    if (!isVisibleToRight(solution.state, point_mm)) continue;
    sigmas_px.push_back(rowSigmaPx(solution, point_mm));
    if (sigmas_px.back() <= worst_px) continue;
    worst_px = sigmas_px.back();
    outlook.worst_at_px = pixel;
  }
  outlook.median_95_px = kTwoSided95 * middleOf(sigmas_px);
  outlook.worst_95_px = kTwoSided95 * worst_px;
  return outlook;
}

}  // namespace softscope
