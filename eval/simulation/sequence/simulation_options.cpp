// eval/simulation/sequence/simulation_options.cpp: checks, and the camera rig.
#include "eval/simulation/sequence/simulation_options.h"

#include <cmath>

#include "core/error.h"
#include "eval/simulation/sequence/simulation_settings.h"

namespace softscope {
namespace {

constexpr double kUsualFocalPerWidth = 0.875;  // horizontal field of view of 59 degrees

}  // namespace

void ScopeOptions::validate() const {
  requireAllowed(*this);
  require(focal_px == 0 || (focal_px >= 0.1 * width_px && focal_px <= 20.0 * width_px),
          "scope.focal_px", focal_px, "must be 0 (choose) or 0.1 to 20 times the width");
  require(cx_px < width_px, "scope.cx_px", cx_px, "must be below the width, or negative (middle)");
  require(cy_px < height_px, "scope.cy_px", cy_px,
          "must be below the height, or negative (middle)");
  require(lens().invertible(), "scope.k1", k1,
          "so the lenses fold the image over itself; bend it less");
}

RectifiedRig ScopeOptions::rig() const {
  RectifiedRig rig;
  const double focal = focal_px > 0 ? focal_px : kUsualFocalPerWidth * width_px;
  rig.left = {width_px,
              height_px,
              focal,
              focal,
              cx_px >= 0 ? cx_px : 0.5 * (width_px - 1),
              cy_px >= 0 ? cy_px : 0.5 * (height_px - 1)};
  rig.baseline_mm = baseline_mm;
  return rig;
}

ScopeLens ScopeOptions::lens() const {
  ScopeLens lens{rig().left, {}};
  lens.distortion.coefficients = {k1, k2, p1, p2, k3};
  return lens;
}

StereoCalibration ScopeOptions::calibration() const {
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = rig().left;
  calibration.left.distortion = calibration.right.distortion = lens().distortion;
  calibration.right_from_left.translation() = Eigen::Vector3d(-baseline_mm, 0, 0);
  calibration.rectified = lens().distortion.isZero();
  calibration.form = "OpenCV";
  return calibration;
}

void SimulationOptions::validate() const {
  requireAllowed(*this);
  require(texel_mm == 0 || texel_mm >= 0.005, "texture.texel_mm", texel_mm,
          "must be 0 (choose) or 0.005 to 10");
  organ.validate();
  texture.validate();
  deformation.validate();
  cut.validate();
  scope.validate();
  camera.validate();
  instrument.validate();
}

}  // namespace softscope
