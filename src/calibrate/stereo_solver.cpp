#include "calibrate/stereo_solver.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/median.h"

namespace softscope {
namespace {

constexpr double kCornerMisfit = 6;  // rejection limit, in sigmas of one coordinate

struct OneCamera {
  RawCamera camera;
  std::vector<Eigen::Isometry3d> camera_from_board;
};

int flagsFor(int lens_coefficients) {
  int flags = 0;
  if (lens_coefficients < 5) flags |= cv::CALIB_FIX_K3;
  if (lens_coefficients < 4) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  if (lens_coefficients < 2) flags |= cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2;
  return flags;
}

Eigen::Isometry3d poseOf(const cv::Mat& rotation, const cv::Mat& translation) {
  cv::Mat matrix;
  cv::Rodrigues(rotation, matrix);
  Eigen::Matrix3d r;
  Eigen::Vector3d t;
  cv::cv2eigen(matrix, r);
  cv::cv2eigen(translation, t);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = r;
  pose.translation() = t;
  return pose;
}

OneCamera solveOne(const std::vector<BoardSighting>& sightings,
                   std::vector<BoardCorner> BoardSighting::*side, const BoardOptions& board,
                   cv::Size size, int lens_coefficients) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardSighting& sighting : sightings) {
    points.emplace_back();
    pixels.emplace_back();
    for (const BoardCorner& corner : sighting.*side) {
      const Eigen::Vector3f p = board.cornerPosition(corner.id).cast<float>();
      points.back().emplace_back(p.x(), p.y(), p.z());
      pixels.back().emplace_back(static_cast<float>(corner.pixel.x()),
                                 static_cast<float>(corner.pixel.y()));
    }
  }
  cv::Mat k, d;
  std::vector<cv::Mat> rotations, translations;
  cv::calibrateCamera(points, pixels, size, k, d, rotations, translations,
                      flagsFor(lens_coefficients));
  OneCamera one;
  one.camera.pinhole = {size.width,         size.height,        k.at<double>(0, 0),
                        k.at<double>(1, 1), k.at<double>(0, 2), k.at<double>(1, 2)};
  for (int i = 0; i < std::min(5, static_cast<int>(d.total())); ++i)
    one.camera.distortion.coefficients[static_cast<std::size_t>(i)] = d.at<double>(i);
  for (std::size_t i = 0; i < rotations.size(); ++i)
    one.camera_from_board.push_back(poseOf(rotations[i], translations[i]));
  return one;
}

/// Component-wise median over the views.
Eigen::Isometry3d commonPose(const OneCamera& left, const OneCamera& right) {
  std::vector<double> values[6];
  for (std::size_t i = 0; i < left.camera_from_board.size(); ++i) {
    const Eigen::Isometry3d one = right.camera_from_board[i] * left.camera_from_board[i].inverse();
    const Eigen::AngleAxisd turn(one.linear());
    const Eigen::Vector3d rotation = turn.angle() * turn.axis();
    for (int k = 0; k < 3; ++k) {
      values[k].push_back(rotation[k]);
      values[3 + k].push_back(one.translation()[k]);
    }
  }
  double medians[6];
  for (int k = 0; k < 6; ++k) medians[k] = medianOf(std::move(values[k]));
  const Eigen::Vector3d rotation(medians[0], medians[1], medians[2]);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0)
    pose.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(medians[3], medians[4], medians[5]);
  return pose;
}

BundleView viewOf(const BoardSighting& sighting, const BoardOptions& board,
                  const Eigen::Isometry3d& left_from_board) {
  BundleView view;
  view.left_from_board = left_from_board;
  for (const BoardCorner& corner : sighting.left)
    view.points.push_back({board.cornerPosition(corner.id), corner.pixel, false});
  for (const BoardCorner& corner : sighting.right)
    view.points.push_back({board.cornerPosition(corner.id), corner.pixel, true});
  return view;
}

double rmsOf(const BundleState& state, const BundleView& view) {
  double squares = 0;
  const std::vector<Eigen::Vector2d> residuals = residualsOf(state, view);
  for (const Eigen::Vector2d& residual : residuals) squares += residual.squaredNorm();
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, residuals.size())));
}

std::string twoDigits(double value) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3);
}

/// Removes views, then single corners, with too large residuals. Returns true if any was removed.
bool leaveOutMisfits(double misfit_ratio, double sigma_px, std::vector<int>* frames,
                     CalibrationSolution* solution) {
  BundleState& state = solution->state;
  std::vector<double> rms;
  for (const BundleView& view : state.views) rms.push_back(rmsOf(state, view));
  const double median = medianOf(rms);
  bool any = false;
  for (std::size_t i = state.views.size(); i-- > 0;) {
    if (rms[i] <= misfit_ratio * median || state.views.size() <= kLeastViews) continue;
    solution->left_out.push_back({(*frames)[i], "does not fit: RMS " + twoDigits(rms[i]) +
                                                    " px, the median view " + twoDigits(median) +
                                                    " px"});
    state.views.erase(state.views.begin() + static_cast<std::ptrdiff_t>(i));
    frames->erase(frames->begin() + static_cast<std::ptrdiff_t>(i));
    any = true;
  }
  if (any) return true;  // sigma must be estimated again without them
  for (BundleView& view : state.views) {
    const std::vector<Eigen::Vector2d> residuals = residualsOf(state, view);
    std::vector<BundlePoint> kept;
    for (std::size_t i = 0; i < residuals.size(); ++i)
      if (residuals[i].norm() <= kCornerMisfit * sigma_px) kept.push_back(view.points[i]);
    if (kept.size() == view.points.size() || kept.size() < 8) continue;
    solution->corners_left_out += static_cast<int>(view.points.size() - kept.size());
    view.points = kept;
    any = true;
  }
  return any;
}

SolvedView describeView(int frame, const BundleState& state, const BundleView& view,
                        const BoardOptions& board) {
  SolvedView solved;
  solved.frame = frame;
  solved.rms_px = rmsOf(state, view);
  const double cosine = std::min(1.0, std::abs(view.left_from_board.linear()(2, 2)));
  solved.tilt_deg = std::acos(cosine) * 180 / M_PI;
  solved.distance_mm =
      (view.left_from_board * (board.cornerPosition(board.cornerCount() - 1) / 2)).z();
  return solved;
}

}  // namespace

void SolveOptions::validate() const {
  bundle.validate();
  require(misfit_ratio > 1, "misfit_ratio", misfit_ratio, "must be above 1");
}

StereoCalibration CalibrationSolution::calibration() const {
  StereoCalibration calibration;
  calibration.left = state.left;
  calibration.right = state.right;
  calibration.right_from_left = state.right_from_left;
  calibration.form = "OpenCV";
  return calibration;
}

CalibrationSolution solveStereo(const std::vector<BoardSighting>& sightings,
                                const BoardOptions& board, int width_px, int height_px,
                                const SolveOptions& options) {
  options.validate();
  if (sightings.size() < kLeastViews)
    throw InputError("there are " + std::to_string(sightings.size()) +
                     " usable views of the board, but a calibration takes " +
                     std::to_string(kLeastViews) + " or more, and 15 to 30 for small intervals.");
  const cv::Size size(width_px, height_px);
  const int lens = options.bundle.lens_coefficients;
  const OneCamera left = solveOne(sightings, &BoardSighting::left, board, size, lens);
  const OneCamera right = solveOne(sightings, &BoardSighting::right, board, size, lens);
  CalibrationSolution solution;
  BundleState& state = solution.state;
  state.left = left.camera;
  state.right = right.camera;
  state.right_from_left = commonPose(left, right);
  std::vector<int> frames;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    state.views.push_back(viewOf(sightings[i], board, left.camera_from_board[i]));
    frames.push_back(sightings[i].frame);
  }
  solution.summary = adjustBundle(options.bundle, &state);
  for (int round = 0; round < 5; ++round) {
    if (!leaveOutMisfits(options.misfit_ratio, solution.summary.sigma_px, &frames, &solution))
      break;
    solution.summary = adjustBundle(options.bundle, &state);
  }
  for (std::size_t i = 0; i < state.views.size(); ++i)
    solution.views.push_back(describeView(frames[i], state, state.views[i], board));
  return solution;
}

}  // namespace softscope
