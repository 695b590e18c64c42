// src/calibrate/bundle.h: joint least squares of both cameras and of all poses.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "calibrate/board.h"
#include "core/stereo_rig.h"

namespace softscope {

/// Unknowns shared by all views, in this order: for the left and the right camera fx, fy,
/// cx, cy (px), k1, k2, p1, p2, k3; rotation (rad) and translation (mm) of right_from_left.
inline constexpr int kCameraUnknowns = 9;
inline constexpr int kRigUnknowns = 2 * kCameraUnknowns + 6;
using RigMatrix = Eigen::Matrix<double, kRigUnknowns, kRigUnknowns>;
using RigVector = Eigen::Matrix<double, kRigUnknowns, 1>;

/// One corner in one camera.
struct BundlePoint {
  Eigen::Vector3d board_mm = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool is_right = false;
};

struct BundleView {
  Eigen::Isometry3d left_from_board = Eigen::Isometry3d::Identity();
  std::vector<BundlePoint> points;
};

struct BundleState {
  RawCamera left, right;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  std::vector<BundleView> views;
};

struct BundleOptions {
  int lens_coefficients = 5;  // number of free coefficients of k1 k2 p1 p2 k3; the others are fixed
  int most_iterations = 100;

  /// Throws OptionError.
  void validate() const;
};

struct BundleSummary {
  bool converged = false;
  int iterations = 0;
  double rms_px = 0;    // root mean square length of the residuals
  double sigma_px = 0;  // of one coordinate: divisor is observations minus unknowns
  /// Of the shared unknowns, from the final Jacobian and sigma_px; 0 for
  /// fixed ones. Rotation: small rotation applied from the left, rad.
  RigMatrix covariance = RigMatrix::Zero();
};

/// Levenberg-Marquardt with elimination of the poses (Schur complement).
/// Throws InputError if the views do not determine the unknowns.
BundleSummary adjustBundle(const BundleOptions& options, BundleState* state);

/// Pixel of a point in the camera frame by OpenCV's model with five coefficients, and
/// derivatives with respect to the point and the camera unknowns (null: not computed).
Eigen::Vector2d projectWithLens(const RawCamera& camera, const Eigen::Vector3d& point_mm,
                                Eigen::Matrix<double, 2, 3>* by_point,
                                Eigen::Matrix<double, 2, kCameraUnknowns>* by_camera);

/// Residuals (pixel minus projection) of the points of a view.
std::vector<Eigen::Vector2d> residualsOf(const BundleState& state, const BundleView& view);

/// Derivatives of a projection by the shared unknowns, and by the point in the left camera frame.
struct RigProjection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, kRigUnknowns> by_rig;
  Eigen::Matrix<double, 2, 3> by_left_point;
};
RigProjection projectThroughRig(const BundleState& state, const Eigen::Vector3d& point_left_mm,
                                bool is_right);

}  // namespace softscope
