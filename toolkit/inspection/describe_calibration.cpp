// toolkit/inspection/describe_calibration.cpp: facts about both cameras.
#include <cmath>

#include "io/calibrations/calibration_reader.h"
#include "io/calibrations/one_camera.h"
#include "toolkit/inspection/describe_file.h"

namespace softscope {
namespace {

constexpr double kReferenceDepthMm = 50;  // typical working distance of an endoscope

double viewDeg(double size_px, double focal_px) {
  return 2 * std::atan(0.5 * size_px / focal_px) * 180 / M_PI;
}

std::string size(const PinholeCamera& camera) {
  return std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) + " px";
}

FactSheet::Json cameraJson(const RawCamera& camera) {
  const PinholeCamera& pinhole = camera.pinhole;
  return {{"fx_px", pinhole.fx_px},
          {"fy_px", pinhole.fy_px},
          {"cx_px", pinhole.cx_px},
          {"cy_px", pinhole.cy_px},
          {"distorted", !camera.distortion.isZero()}};
}

std::string cameraText(const RawCamera& camera) {
  const PinholeCamera& pinhole = camera.pinhole;
  return "focal length " + fixed(pinhole.fx_px, 1) + ", " + fixed(pinhole.fy_px, 1) +
         " px, centre " + fixed(pinhole.cx_px, 1) + ", " + fixed(pinhole.cy_px, 1) +
         (camera.distortion.isZero() ? "" : ", lens distortion");
}

}  // namespace

void addCalibration(const StereoCalibration& calibration, const std::string& key,
                    FactSheet& facts) {
  const std::string at = key.empty() ? "" : key + ".";
  const PinholeCamera& left = calibration.left.pinhole;
  const bool one = hasOneCamera(calibration);
  const double turn_deg =
      Eigen::AngleAxisd(calibration.right_from_left.rotation()).angle() * 180 / M_PI;
  const double step_mm =
      kReferenceDepthMm * kReferenceDepthMm / (left.fx_px * calibration.baseline_mm());
  facts.add("calibration", calibration.form + ", " + calibration.source, at + "form",
            calibration.form);
  facts.addQuietly(at + "source", calibration.source);
  if (left.width_px > 0) {
    facts.add("for images of", size(left), at + "image_width_px", left.width_px);
    facts.addQuietly(at + "image_height_px", left.height_px);
    const double across_deg = viewDeg(left.width_px, left.fx_px);
    const double down_deg = viewDeg(left.height_px, left.fy_px);
    facts.add("field of view", fixed(across_deg, 1) + " x " + fixed(down_deg, 1) + " degrees",
              at + "field_of_view_deg", {across_deg, down_deg});
  } else {
    facts.missing("the image size that the calibration holds for");
  }
  facts.add(one ? "camera" : "left camera", cameraText(calibration.left), at + "left",
            cameraJson(calibration.left));
  if (one) {
    facts.add("depth files", fixed(calibration.depth_unit_mm, 5) + " mm a step of 16-bit files",
              at + "depth_unit_mm", calibration.depth_unit_mm);
    for (const std::string& warning : calibration.warnings) facts.warn(warning);
    return;
  }
  facts.add("right camera", cameraText(calibration.right), at + "right",
            cameraJson(calibration.right));
  facts.add("baseline", fixed(calibration.baseline_mm(), 3) + " mm", at + "baseline_mm",
            calibration.baseline_mm());
  facts.add("turned by", fixed(turn_deg, 2) + " degrees", at + "rotation_deg", turn_deg);
  facts.add("rectified", calibration.rectified ? "yes" : "no, images are rectified when read",
            at + "rectified", calibration.rectified);
  facts.add("1 px of disparity", "is " + fixed(step_mm, 2) + " mm of depth at 50 mm",
            at + "depth_of_1px_at_50mm_mm", step_mm);
  for (const std::string& warning : calibration.warnings) facts.warn(warning);
}

FactSheet describeCalibration(const std::string& path) {
  const StereoCalibration calibration = readCalibration(path);
  FactSheet facts(path + (hasOneCamera(calibration) ? ": a calibration of one camera"
                                                    : ": a stereo calibration"));
  facts.addQuietly("kind", "calibration");
  addCalibration(calibration, "", facts);
  return facts;
}

}  // namespace softscope
