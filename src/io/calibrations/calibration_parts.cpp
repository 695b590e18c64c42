#include "io/calibrations/calibration_parts.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {
namespace {

// Tolerance for four digits; larger deviations are not a rotation.
constexpr double kRotationTolerance = 2e-3;
constexpr double kExactRotation = 1e-14;

void requireFinite(const std::vector<double>& values, const std::string& what) {
  for (const double value : values)
    if (!std::isfinite(value))
      throw InputError(say(what, " holds ", value, ", but numbers are expected. Calibrate again."));
}

Eigen::Matrix3d fromRotationVector(const std::vector<double>& v) {
  const Eigen::Vector3d vector(v[0], v[1], v[2]);
  const double angle_rad = vector.norm();
  if (angle_rad == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, vector / angle_rad).toRotationMatrix();
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix, const std::string& what) {
  const double off =
      (matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRotationTolerance) || matrix.determinant() < 0)
    throw InputError(say(what, " is no rotation: R Rᵀ is ", off, " off the identity, determinant ",
                         matrix.determinant(), ". Calibrate or export it again."));
  if (off <= kExactRotation) return matrix;  // exact round trip of our own files
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

void setCameraMatrix(PinholeCamera& camera, const std::vector<double>& matrix,
                     const std::string& what) {
  if (matrix.size() != 9)
    throw InputError(say(what, " has ", matrix.size(), " numbers, but a camera matrix has 3 x 3."));
  requireFinite(matrix, what);
  if (matrix[3] != 0 || matrix[6] != 0 || matrix[7] != 0 || std::abs(matrix[8] - 1) > 1e-6)
    throw InputError(say(what, " is not of the form fx 0 cx, 0 fy cy, 0 0 1; its third row is ",
                         matrix[6], " ", matrix[7], " ", matrix[8],
                         ". MATLAB's matrices are transposed: turn them."));
  if (std::abs(matrix[1]) > 1e-3 * std::abs(matrix[0]))
    throw InputError(say(what, " has a skew of ", matrix[1],
                         ", but pixels must be rectangular. Calibrate without skew."));
  camera.fx_px = matrix[0];
  camera.fy_px = matrix[4];
  camera.cx_px = matrix[2];
  camera.cy_px = matrix[5];
}

LensDistortion distortionFrom(const std::vector<double>& values, const std::string& what) {
  const std::size_t n = values.size();
  if (n != 0 && n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    throw InputError(say(what, " has ", n, " numbers, but OpenCV's lens model has 4, 5, 8 or 12."));
  requireFinite(values, what);
  if (n == 14 && (values[12] != 0 || values[13] != 0))
    throw InputError(what +
                     " has a tilted sensor, which is not known here. Calibrate without tilt.");
  LensDistortion out;
  std::copy_n(values.begin(), std::min(n, out.coefficients.size()), out.coefficients.begin());
  return out;
}

bool isRational(const LensDistortion& distortion) {
  const auto& k = distortion.coefficients;
  return k[5] != 0 || k[6] != 0 || k[7] != 0;
}

int wholePixels(double value, int least, const std::string& what) {
  if (!(value >= least && value <= 1e6) || value != std::floor(value))
    throw InputError(say(what, " is ", value, ", but a whole number of pixels is expected."));
  return static_cast<int>(value);
}

Eigen::Isometry3d poseFrom(const std::vector<double>& rotation,
                           const std::vector<double>& translation, const std::string& rotation_what,
                           const std::string& translation_what) {
  if (rotation.size() != 9 && rotation.size() != 3)
    throw InputError(say(rotation_what, " has ", rotation.size(),
                         " numbers, but a rotation has 3 x 3, or 3 as a rotation vector."));
  if (translation.size() != 3)
    throw InputError(
        say(translation_what, " has ", translation.size(), " numbers, but a translation has 3."));
  requireFinite(rotation, rotation_what);
  requireFinite(translation, translation_what);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (rotation.size() == 3) {
    pose.linear() = fromRotationVector(rotation);
  } else {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> matrix(rotation.data());
    pose.linear() = nearestRotation(matrix, rotation_what);
  }
  pose.translation() = Eigen::Vector3d(translation[0], translation[1], translation[2]);
  return pose;
}

}  // namespace softscope
