#include "io/calibrations/calibration_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/length_unit.h"
#include "io/calibrations/calibration_parts.h"
#include "io/images/picture_limits.h"
#include "io/text/message.h"

namespace softscope {
namespace {

constexpr CalibrationLimits kLimits;
constexpr double kDegreesPerRadian = 57.29577951308232;
// Tolerance for rounded numbers, and for a rectification in single precision.
constexpr double kRectifiedAngleDeg = 0.1;
constexpr double kRectifiedRowsPx = 2.0;
constexpr double kRectifiedFocalRatio = 0.005;
// Centre of an image of another size, in shares of the image side; ratio of both shares.
constexpr double kScaledCentre = 0.58;
constexpr double kSameFactor = 0.1;
constexpr double kLensSlope = 1;  // lens models may diverge beyond 45 degrees

using Warnings = std::vector<std::string>;

void checkFocal(const RawCamera& camera, const std::string& what, Warnings& warnings) {
  const auto require = [&](double focal_px, const char* name) {
    if (focal_px > 0 && focal_px <= kLimits.most_focal_px) return;
    throw InputError(say(what, "'s ", name, " is ", focal_px,
                         " px, but a focal length is a positive number up to ",
                         kLimits.most_focal_px, " px. Calibrate or export it again."));
  };
  require(camera.pinhole.fx_px, "fx");
  require(camera.pinhole.fy_px, "fy");
  const double aspect = camera.pinhole.fx_px / camera.pinhole.fy_px;
  if (aspect > kLimits.usual_most_aspect || aspect < 1 / kLimits.usual_most_aspect)
    warnings.push_back(say(what, "'s fx / fy is ", aspect,
                           ", but pixels are nearly square. Was the ", "image stretched?"));
}

/// Coefficients k1 k2 k3 p1 p2 give a p1 as large as k3.
void checkTangential(const RawCamera& camera, const std::string& what, Warnings& warnings) {
  const auto& k = camera.distortion.coefficients;
  for (const auto& [name, value] : {std::pair{"p1", k[2]}, std::pair{"p2", k[3]}}) {
    if (std::abs(value) <= kLimits.usual_most_tangential) continue;
    warnings.push_back(say(what, "'s ", name, " is ", value, ", but that of a lens is within ",
                           kLimits.usual_most_tangential,
                           " of 0. The expected order is k1 k2 p1 p2 k3; is it k1 k2 k3 p1 p2?"));
    return;
  }
}

/// Rectification may move the principal point outside
/// of the image, but by less than its longest side.
void checkPrincipalPoint(const PinholeCamera& camera, const std::string& what) {
  if (std::abs(camera.cx_px) <= kMostSidePx && std::abs(camera.cy_px) <= kMostSidePx) return;
  throw InputError(say(what, "'s principal point is (", camera.cx_px, ", ", camera.cy_px,
                       ") px, but it lies near the middle of the image, and none has more than ",
                       kMostSidePx, " pixels a side. Calibrate or export it again."));
}

struct UnitGuess {
  const char* unit;
  double mm;
  const char* advice;
};
constexpr std::array<UnitGuess, 4> kUnitGuesses = {
    {{"m", 1000, "In metres? Then write `unit: m` (or set calibration.unit)."},
     {"cm", 10, "In centimetres? Then write `unit: cm` (or set calibration.unit)."},
     {"mm", 1, "In millimetres? Then write `unit: mm` (or set calibration.unit)."},
     {"um", 0.001, "In micrometres? Then divide T by 1000 (or set calibration.baseline_mm)."}}};

/// Advice for the unit in which a baseline given in `unit` is that of
/// an endoscope; `otherwise` if there is none.
std::string guessUnit(double baseline_mm, const std::string& unit, const char* otherwise) {
  const auto given = lengthUnitNamed(unit);
  const double in_file = baseline_mm / (given ? given->mm : 1);
  for (const UnitGuess& guess : kUnitGuesses) {
    const double mm = in_file * guess.mm;
    if (unit != guess.unit && mm >= kLimits.likely_least_baseline_mm &&
        mm <= kLimits.likely_most_baseline_mm)
      return guess.advice;
  }
  return otherwise;
}

void checkBaseline(const StereoCalibration& calibration, const std::string& unit,
                   Warnings& warnings) {
  const double mm = calibration.baseline_mm();
  const std::string found =
      say(calibration.source, ": the baseline is ", mm, " mm, but an endoscope's is ",
          kLimits.usual_least_baseline_mm, " to ", kLimits.usual_most_baseline_mm, " mm. ");
  if (!(mm >= kLimits.least_baseline_mm && mm <= kLimits.most_baseline_mm))
    throw InputError(found + guessUnit(mm, unit,
                                       "Calibrate again, or give its length (or set "
                                       "calibration.unit, calibration.baseline_mm)."));
  if (mm < kLimits.usual_least_baseline_mm || mm > kLimits.usual_most_baseline_mm)
    warnings.push_back(found + guessUnit(mm, unit, "Is it meant?"));
}

void checkSides(const StereoCalibration& calibration, Warnings& warnings) {
  const Eigen::Vector3d centre =
      Eigen::Vector3d::Zero() -  // 0 instead of -0
      calibration.right_from_left.linear().transpose() * calibration.right_from_left.translation();
  if (!(centre.x() > 0 && std::abs(centre.y()) < centre.x()))
    throw InputError(say(calibration.source, ": the right camera lies at (", centre.x(), ", ",
                         centre.y(), ", ", centre.z(),
                         ") mm of the left one, but it must lie to its ",
                         "right (x > 0). Are left and right exchanged, or T from right to left?"));
  const double angle_deg =
      Eigen::AngleAxisd(calibration.right_from_left.linear()).angle() * kDegreesPerRadian;
  if (angle_deg > kLimits.usual_most_convergence_deg)
    warnings.push_back(say(calibration.source, ": the cameras are turned by ", angle_deg,
                           "° against each other, but an endoscope's by less than ",
                           kLimits.usual_most_convergence_deg, "°. Is R meant?"));
}

void checkRectified(const StereoCalibration& calibration) {
  if (!calibration.rectified) return;
  const auto contradict = [&](const std::string& found) {
    throw InputError(say(calibration.source, ": said to be rectified, but ", found,
                         ". Give the rectified cameras, or `rectified: 0` with the raw images."));
  };
  if (!calibration.left.distortion.isZero() || !calibration.right.distortion.isZero())
    contradict("its lens distortion is not 0");
  const double angle_deg =
      Eigen::AngleAxisd(calibration.right_from_left.linear()).angle() * kDegreesPerRadian;
  if (angle_deg > kRectifiedAngleDeg) contradict(say("R turns by ", angle_deg, "°"));
  const PinholeCamera &left = calibration.left.pinhole, &right = calibration.right.pinhole;
  if (std::abs(left.fx_px / right.fx_px - 1) > kRectifiedFocalRatio ||
      std::abs(left.fy_px / right.fy_px - 1) > kRectifiedFocalRatio)
    contradict(say("the focal lengths differ, ", left.fx_px, " and ", right.fx_px, " px"));
  if (!(std::abs(left.cy_px - right.cy_px) <= kRectifiedRowsPx))
    contradict(say("cy differs, ", left.cy_px, " and ", right.cy_px, " px"));
}

/// Displacement of the point (x, y) at unit depth by the lens, px: OpenCV's model (core/camera.h).
double lensShiftPx(const RawCamera& camera, double x, double y) {
  const auto& k = camera.distortion.coefficients;
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial =
      (1 + k[0] * r2 + k[1] * r4 + k[4] * r6) / (1 + k[5] * r2 + k[6] * r4 + k[7] * r6);
  const double moved_x =
      x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x) + k[8] * r2 + k[9] * r4;
  const double moved_y =
      y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y + k[10] * r2 + k[11] * r4;
  return std::hypot((moved_x - x) * camera.pinhole.fx_px, (moved_y - y) * camera.pinhole.fy_px);
}

/// Throws if the lens displaces a point at the middle of an image
/// side (at most at 45 degrees) by more than the length of the image.
void checkLens(const RawCamera& camera, const std::string& what, const std::string& form) {
  const PinholeCamera& pinhole = camera.pinhole;
  const double across = std::min(pinhole.width_px / (2 * pinhole.fx_px), kLensSlope);
  const double down = std::min(pinhole.height_px / (2 * pinhole.fy_px), kLensSlope);
  const double diagonal_px = std::hypot(pinhole.width_px, pinhole.height_px);
  const char* advice = form == kOpenCasForm && !isRational(camera.distortion)
                           ? " px. Half of the rational lens model, k4 k5 k6, is missing in the "
                             "five-file form; use the one-file form (…_Calibration.txt)."
                           : " px. A distortion coefficient is damaged; calibrate or export it "
                             "again.";
  for (const auto& [x, y] : {std::pair{across, 0.0}, std::pair{0.0, down}}) {
    const double shift_px = lensShiftPx(camera, x, y);
    if (!(shift_px <= diagonal_px))
      throw InputError(say(what, "'s lens moves the edge of the image by ", shift_px,
                           " px, but the image is ", pinhole.width_px, " x ", pinhole.height_px,
                           advice));
  }
}

void checkView(const PinholeCamera& camera, const std::string& what, Warnings& warnings) {
  const double view_deg = 2 * std::atan(camera.width_px / (2 * camera.fx_px)) * kDegreesPerRadian;
  if (view_deg < kLimits.usual_least_view_deg || view_deg > kLimits.usual_most_view_deg)
    warnings.push_back(say(what, " sees ", view_deg, "° (fx ", camera.fx_px, " px on ",
                           camera.width_px, " px), but an endoscope sees ",
                           kLimits.usual_least_view_deg, " to ", kLimits.usual_most_view_deg,
                           "°. Was it calibrated at this size?"));
  const auto central = [](double c, int size) { return c >= 0.25 * size && c <= 0.75 * size; };
  if (!central(camera.cx_px, camera.width_px) || !central(camera.cy_px, camera.height_px))
    warnings.push_back(say(what, "'s principal point (", camera.cx_px, ", ", camera.cy_px,
                           ") lies far from the middle of ", camera.width_px, " x ",
                           camera.height_px, " pixels. Was it calibrated at this size?"));
}

/// True if the principal point is off the middle by about the same factor in x and
/// y, as in an image of another size.
bool isFarFromMiddle(const PinholeCamera& camera) {
  const double across = (camera.cx_px + 0.5) / camera.width_px;
  const double down = (camera.cy_px + 0.5) / camera.height_px;
  const bool beyond = across > kScaledCentre && down > kScaledCentre;
  const bool before = across < 1 - kScaledCentre && down < 1 - kScaledCentre;
  return (beyond || before) && std::abs(across / down - 1) <= kSameFactor;
}

}  // namespace

std::vector<std::string> checkCalibration(const StereoCalibration& calibration,
                                          const std::string& unit) {
  Warnings warnings;
  checkFocal(calibration.left, calibration.source + ": the left camera", warnings);
  checkFocal(calibration.right, calibration.source + ": the right camera", warnings);
  checkTangential(calibration.left, calibration.source + ": the left camera", warnings);
  checkTangential(calibration.right, calibration.source + ": the right camera", warnings);
  checkPrincipalPoint(calibration.left.pinhole, calibration.source + ": the left camera");
  checkPrincipalPoint(calibration.right.pinhole, calibration.source + ": the right camera");
  checkBaseline(calibration, unit, warnings);
  checkSides(calibration, warnings);
  checkRectified(calibration);
  if (!(calibration.depth_unit_mm >= 1e-5 && calibration.depth_unit_mm <= 10))
    throw InputError(say(calibration.source, ": depth_unit_mm is ", calibration.depth_unit_mm,
                         ", but one step of a depth file is 0.00001 to 10 mm."));
  return warnings;
}

std::vector<std::string> checkPictureFit(const StereoCalibration& calibration) {
  const PinholeCamera &left = calibration.left.pinhole, &right = calibration.right.pinhole;
  if (left.width_px != right.width_px || left.height_px != right.height_px)
    throw InputError(say(calibration.source, ": the left camera has ", left.width_px, " x ",
                         left.height_px, " pixels, the right one ", right.width_px, " x ",
                         right.height_px, ", but both must have the same."));
  if (left.width_px == 0 || left.height_px == 0) return {};
  requirePictureSize(left.width_px, left.height_px, calibration.source);
  checkLens(calibration.left, calibration.source + ": the left camera", calibration.form);
  checkLens(calibration.right, calibration.source + ": the right camera", calibration.form);
  Warnings warnings;
  checkView(left, calibration.source + ": the left camera", warnings);
  checkView(right, calibration.source + ": the right camera", warnings);
  return warnings;
}

std::vector<std::string> checkAssumedSize(const StereoCalibration& calibration) {
  const PinholeCamera &left = calibration.left.pinhole, &right = calibration.right.pinhole;
  if (!isFarFromMiddle(left) || !isFarFromMiddle(right) ||
      (left.cx_px > left.width_px / 2.0) != (right.cx_px > right.width_px / 2.0))
    return {};
  // The centre of the pixel (0, 0) has the coordinates 0, 0.
  const double width_px = left.cx_px + right.cx_px + 1, height_px = left.cy_px + right.cy_px + 1;
  return {say(calibration.source, ": its principal points, (", left.cx_px, ", ", left.cy_px,
              ") and (", right.cx_px, ", ", right.cy_px, "), are those of images of about ",
              std::llround(width_px), " x ", std::llround(height_px), " pixels, not of ",
              left.width_px, " x ", left.height_px, ". Give the calibration made for this size.")};
}

}  // namespace softscope
