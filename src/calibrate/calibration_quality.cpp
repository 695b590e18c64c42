#include "calibrate/calibration_quality.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "core/not_measured.h"

namespace softscope {
namespace {

constexpr double kNinetyFive = 1.959964;  // sigmas of a normal distribution, two-sided

std::vector<double> valuesOf(const RawCamera& camera) {
  const auto& c = camera.distortion.coefficients;
  return {camera.pinhole.fx_px,
          camera.pinhole.fy_px,
          camera.pinhole.cx_px,
          camera.pinhole.cy_px,
          c[0],
          c[1],
          c[2],
          c[3],
          c[4]};
}

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// Derivative of the rotation vector with respect to a small rotation from the left:
/// the inverse left Jacobian of SO(3), to second order (error 1e-4 below 20 degrees).
Eigen::Matrix3d vectorByTurn(const Eigen::Vector3d& r) {
  Eigen::Matrix3d x;
  x << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return Eigen::Matrix3d::Identity() - x / 2 + x * x / 12;
}

void addCamera(const char* side, const RawCamera& camera, const RigMatrix& covariance, int first,
               std::vector<ParameterInterval>* intervals) {
  const char* const names[] = {"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3"};
  const std::vector<double> values = valuesOf(camera);
  for (int i = 0; i < kCameraUnknowns; ++i) {
    const double variance = covariance(first + i, first + i);
    if (variance > 0)
      intervals->push_back({std::string(side) + "." + names[i], values[static_cast<std::size_t>(i)],
                            kNinetyFive * std::sqrt(variance)});
  }
}

cv::Mat matrixOf(const RawCamera& camera) {
  cv::Mat k;
  cv::eigen2cv(camera.pinhole.matrix(), k);
  return k;
}

cv::Mat lensOf(const RawCamera& camera) {
  return cv::Mat(1, 12, CV_64F, const_cast<double*>(camera.distortion.coefficients.data())).clone();
}

std::vector<cv::Point2d> rectified(const std::vector<Eigen::Vector2d>& pixels,
                                   const RawCamera& camera, const cv::Mat& rotation,
                                   const cv::Mat& projection) {
  std::vector<cv::Point2d> raw, out;
  for (const Eigen::Vector2d& pixel : pixels) raw.emplace_back(pixel.x(), pixel.y());
  if (raw.empty()) return out;
  cv::undistortPoints(raw, out, matrixOf(camera), lensOf(camera), rotation, projection,
                      {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-8});
  return out;
}

/// Pixels of the corners visible in both views of one pair.
void addPairs(const BundleView& view, std::vector<Eigen::Vector2d>* left_px,
              std::vector<Eigen::Vector2d>* right_px) {
  const auto key = [](const Eigen::Vector3d& p) { return std::make_pair(p.x(), p.y()); };
  std::map<std::pair<double, double>, Eigen::Vector2d> left;
  for (const BundlePoint& point : view.points)
    if (!point.is_right) left[key(point.board_mm)] = point.pixel;
  for (const BundlePoint& point : view.points) {
    const auto partner = left.find(key(point.board_mm));
    if (!point.is_right || partner == left.end()) continue;
    left_px->push_back(partner->second);
    right_px->push_back(point.pixel);
  }
}

std::size_t cellOf(const Eigen::Vector2d& pixel, const PinholeCamera& camera, int across,
                   int down) {
  const auto part = [](double at, int size, int cells) {
    return std::clamp(static_cast<int>(at / size * cells), 0, cells - 1);
  };
  return static_cast<std::size_t>(part(pixel.y(), camera.height_px, down) * across +
                                  part(pixel.x(), camera.width_px, across));
}

double shareOfSome(const std::vector<int>& counts) {
  const auto some = std::count_if(counts.begin(), counts.end(), [](int n) { return n > 0; });
  return static_cast<double>(some) / static_cast<double>(counts.size());
}

/// Corners and sides of the image without a corner of the board in either view.
std::vector<std::string> emptyParts(const BoardCoverage& coverage) {
  const char* const rows[] = {"upper", "middle", "lower"};
  const char* const columns[] = {"left", "middle", "right"};
  std::vector<std::string> parts;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      int empty = 0, cells = 0;
      for (int v = row * kCellsDown / 3; v < (row + 1) * kCellsDown / 3; ++v)
        for (int u = column * kCellsAcross / 3; u < (column + 1) * kCellsAcross / 3; ++u) {
          const auto cell = static_cast<std::size_t>(v * kCellsAcross + u);
          empty += coverage.left_counts[cell] == 0 || coverage.right_counts[cell] == 0;
          ++cells;
        }
      if (2 * empty > cells)
        parts.push_back(row == 1 && column == 1 ? std::string("the middle")
                                                : std::string(rows[row]) + " " + columns[column]);
    }
  return parts;
}

}  // namespace

std::vector<ParameterInterval> parameterIntervals(const CalibrationSolution& solution) {
  std::vector<ParameterInterval> intervals;
  const RigMatrix& covariance = solution.summary.covariance;
  addCamera("left", solution.state.left, covariance, 0, &intervals);
  addCamera("right", solution.state.right, covariance, kCameraUnknowns, &intervals);
  const Eigen::Isometry3d& pose = solution.state.right_from_left;
  const Eigen::Vector3d rotation = rotationVector(pose.linear()), t = pose.translation();
  const Eigen::Matrix3d by_turn = vectorByTurn(rotation);
  const Eigen::Matrix3d turn_covariance =
      by_turn * covariance.block<3, 3>(2 * kCameraUnknowns, 2 * kCameraUnknowns) *
      by_turn.transpose();
  const Eigen::Matrix3d t_covariance = covariance.bottomRightCorner<3, 3>();
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    intervals.push_back({std::string("rotation_") + axes[i] + "_deg", rotation[i] * 180 / M_PI,
                         kNinetyFive * std::sqrt(turn_covariance(i, i)) * 180 / M_PI});
  for (int i = 0; i < 3; ++i)
    intervals.push_back({std::string("translation_") + axes[i] + "_mm", t[i],
                         kNinetyFive * std::sqrt(t_covariance(i, i))});
  const Eigen::Vector3d along = t.normalized();
  intervals.push_back(
      {"baseline_mm", t.norm(), kNinetyFive * std::sqrt(along.dot(t_covariance * along))});
  return intervals;
}

std::vector<double> rowDifferencesPx(const StereoCalibration& calibration,
                                     const std::vector<Eigen::Vector2d>& left_px,
                                     const std::vector<Eigen::Vector2d>& right_px) {
  cv::Mat r, t, left_rotation, right_rotation, left_projection, right_projection, q;
  cv::eigen2cv(Eigen::Matrix3d(calibration.right_from_left.linear()), r);
  cv::eigen2cv(Eigen::Vector3d(calibration.right_from_left.translation()), t);
  const cv::Size size(calibration.left.pinhole.width_px, calibration.left.pinhole.height_px);
  cv::stereoRectify(matrixOf(calibration.left), lensOf(calibration.left),
                    matrixOf(calibration.right), lensOf(calibration.right), size, r, t,
                    left_rotation, right_rotation, left_projection, right_projection, q,
                    cv::CALIB_ZERO_DISPARITY, -1, size);
  const auto left = rectified(left_px, calibration.left, left_rotation, left_projection);
  const auto right = rectified(right_px, calibration.right, right_rotation, right_projection);
  std::vector<double> differences;
  for (std::size_t i = 0; i < left.size(); ++i) differences.push_back(left[i].y - right[i].y);
  return differences;
}

RowErrors rowErrors(const CalibrationSolution& solution) {
  std::vector<Eigen::Vector2d> left_px, right_px;
  for (const BundleView& view : solution.state.views) addPairs(view, &left_px, &right_px);
  const std::vector<double> rows = rowDifferencesPx(solution.calibration(), left_px, right_px);
  constexpr std::size_t kRegions = kRegionsAcross * kRegionsDown;
  std::vector<double> sums(kRegions, 0), counts(kRegions, 0);
  double squares = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t cell =
        cellOf(left_px[i], solution.state.left.pinhole, kRegionsAcross, kRegionsDown);
    sums[cell] += rows[i];
    counts[cell] += 1;
    squares += rows[i] * rows[i];
  }
  RowErrors errors;
  errors.rms_px =
      rows.empty() ? kNotMeasured<double> : std::sqrt(squares / static_cast<double>(rows.size()));
  errors.worst_region_px = kNotMeasured<double>;
  for (std::size_t i = 0; i < kRegions; ++i) {
    const double mean = counts[i] < 10 ? kNotMeasured<double> : sums[i] / counts[i];
    errors.region_mean_px.push_back(mean);
    if (std::isfinite(mean) && !(std::abs(mean) <= errors.worst_region_px))
      errors.worst_region_px = std::abs(mean);
  }
  return errors;
}

DepthOutlook depthOutlook(const CalibrationSolution& solution, double distance_mm,
                          double disparity_sigma_px) {
  const Eigen::Vector3d point(0, 0, distance_mm);
  const RigProjection left = projectThroughRig(solution.state, point, false);
  const RigProjection right = projectThroughRig(solution.state, point, true);
  // The three coordinates of a rectified match: its left pixel and its right column.
  Eigen::Matrix3d by_point;
  by_point << left.by_left_point, right.by_left_point.row(0);
  Eigen::Matrix<double, 3, kRigUnknowns> by_rig;
  by_rig << left.by_rig, right.by_rig.row(0);
  const Eigen::Matrix3d point_by_pixels = by_point.inverse();
  // At constant pixels, an error of the unknowns moves the point by -by_point^-1 by_rig.
  const Eigen::Matrix<double, 1, kRigUnknowns> depth_by_rig = -point_by_pixels.row(2) * by_rig;
  DepthOutlook outlook;
  outlook.distance_mm = distance_mm;
  outlook.sigma_mm = std::abs(point_by_pixels(2, 2)) * disparity_sigma_px;
  const double variance =
      (depth_by_rig * solution.summary.covariance * depth_by_rig.transpose())(0, 0);
  outlook.bias_95_mm = kNinetyFive * std::sqrt(std::max(0.0, variance));
  return outlook;
}

BoardCoverage boardCoverage(const CalibrationSolution& solution) {
  constexpr std::size_t kCells = kCellsAcross * kCellsDown;
  BoardCoverage coverage;
  coverage.left_counts.assign(kCells, 0);
  coverage.right_counts.assign(kCells, 0);
  for (const BundleView& view : solution.state.views)
    for (const BundlePoint& point : view.points) {
      const RawCamera& camera = point.is_right ? solution.state.right : solution.state.left;
      ++(point.is_right
             ? coverage.right_counts
             : coverage.left_counts)[cellOf(point.pixel, camera.pinhole, kCellsAcross, kCellsDown)];
    }
  coverage.left_share = shareOfSome(coverage.left_counts);
  coverage.right_share = shareOfSome(coverage.right_counts);
  return coverage;
}

std::vector<std::string> imagingAdvice(const CalibrationSolution& solution,
                                       const BoardCoverage& coverage) {
  std::vector<std::string> advice;
  const auto count = solution.views.size();
  if (count < 12)
    advice.push_back("more views: there are " + std::to_string(count) + ", 15 to 30 are usual");
  std::string parts;
  for (const std::string& part : emptyParts(coverage)) parts += (parts.empty() ? "" : ", ") + part;
  if (!parts.empty())
    advice.push_back("the board in these parts of the image, in both views: " + parts);
  const auto tilted = std::count_if(solution.views.begin(), solution.views.end(),
                                    [](const SolvedView& view) { return view.tilt_deg >= 15; });
  if (3 * static_cast<std::size_t>(tilted) < count)
    advice.push_back(
        "the board tilted by 20 to 40 degrees, to all four sides: " + std::to_string(tilted) +
        " of " + std::to_string(count) + " views are tilted by 15 or more");
  const auto [nearest, farthest] = std::minmax_element(
      solution.views.begin(), solution.views.end(),
      [](const SolvedView& a, const SolvedView& b) { return a.distance_mm < b.distance_mm; });
  if (count > 0 && farthest->distance_mm < 1.4 * nearest->distance_mm)
    advice.push_back("the board nearer and farther: all views lie " +
                     std::to_string(std::lround(nearest->distance_mm)) + " to " +
                     std::to_string(std::lround(farthest->distance_mm)) + " mm away");
  return advice;
}

}  // namespace softscope
