// src/io/calibrations/ros_calibration.cpp: pair of ROS camera_info, in metres.
#include <array>
#include <cmath>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/documents/number_tree.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

struct CameraInfo {
  RawCamera raw;
  PinholeCamera rectified;             // from the projection matrix
  Eigen::Matrix3d rectified_from_raw;  // the rectification matrix
  double fx_baseline = 0;              // P(0,3): -fx * distance to the left camera
};

/// Key of the files of camera_calibration, or of the message in ROS 1 (K) and 2 (k).
const Document* findEither(const Document& info, std::string_view key) {
  constexpr std::array<std::array<std::string_view, 3>, 6> kNames{
      {{"camera_matrix", "K", "k"},
       {"distortion_coefficients", "D", "d"},
       {"rectification_matrix", "R", "r"},
       {"projection_matrix", "P", "p"},
       {"image_width", "width", "width"},
       {"image_height", "height", "height"}}};
  for (const auto& names : kNames) {
    if (names[0] != key) continue;
    for (const std::string_view name : names)
      if (const Document* found = info.find(name)) return found;
  }
  return nullptr;
}

const Document& member(const Document& info, std::string_view key, const std::string& name) {
  const Document* found = findEither(info, key);
  if (!found)
    throw InputError(say(name, ": ", key,
                         " is missing, but ROS camera_info has it. Calibrate with ",
                         "camera_calibration and give both files."));
  return *found;
}

std::vector<double> numbers(const Document& info, std::string_view key, std::size_t count,
                            const std::string& name) {
  const std::string what = say(name, ": ", key);
  std::vector<double> out = numbersOf(member(info, key, name), what);
  if (out.size() != count)
    throw InputError(say(what, " has ", out.size(), " numbers, but ", count, " are expected."));
  return out;
}

int pixels(const Document& info, std::string_view key, const std::string& name) {
  const double value = numbers(info, key, 1, name)[0];
  if (!(value >= 1 && value <= 1e6) || value != std::floor(value))
    throw InputError(say(name, ": ", key, " is ", value, ", but a whole number is expected."));
  return static_cast<int>(value);
}

CameraInfo cameraInfoFrom(const Document& info, const std::string& name) {
  CameraInfo out;
  PinholeCamera& camera = out.raw.pinhole;
  camera.width_px = pixels(info, "image_width", name);
  camera.height_px = pixels(info, "image_height", name);
  setCameraMatrix(camera, numbers(info, "camera_matrix", 9, name), name + ": camera_matrix");
  out.raw.distortion = distortionFrom(
      numbersOf(member(info, "distortion_coefficients", name), name + ": distortion_coefficients"),
      name + ": distortion_coefficients");
  const std::string rotation = name + ": rectification_matrix";
  out.rectified_from_raw =
      poseFrom(numbers(info, "rectification_matrix", 9, name), {0, 0, 0}, rotation, rotation)
          .linear();
  const std::vector<double> p = numbers(info, "projection_matrix", 12, name);
  out.rectified = camera;
  setCameraMatrix(out.rectified, {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]},
                  name + ": projection_matrix");
  out.fx_baseline = p[3];
  return out;
}

/// -B: x of the left camera in the right rectified frame.
double shiftOf(const CameraInfo& right, const std::string& name) {
  const double shift = right.fx_baseline / right.rectified.fx_px;
  if (!std::isfinite(shift) || shift == 0)
    throw InputError(
        say(name, ": the right camera's projection_matrix has ", right.fx_baseline,
            " in its fourth column, but -fx * baseline is expected (metres). Calibrate ",
            "both cameras together."));
  return shift;
}

}  // namespace

bool isCameraInfo(const Document& document) {
  return findEither(document, "projection_matrix") && findEither(document, "camera_matrix");
}

CalibrationDraft draftFromRos(const Document& left, const Document& right, const std::string& name,
                              bool rectified) {
  const CameraInfo l = cameraInfoFrom(left, name + ": left");
  const CameraInfo r = cameraInfoFrom(right, name + ": right");
  const Eigen::Vector3d shift(shiftOf(r, name), 0, 0);
  CalibrationDraft draft;
  draft.unit = "m";  // REP 103
  StereoCalibration& out = draft.calibration;
  out.form = "ROS";
  if (rectified) {
    out.left.pinhole = l.rectified;
    out.right.pinhole = r.rectified;
    out.right_from_left.translation() = shift;
    return draft;
  }
  out.left = l.raw;
  out.right = r.raw;
  // p_rect_right = p_rect_left + shift, each p_rect = rectified_from_raw * p_raw.
  out.right_from_left.linear() = r.rectified_from_raw.transpose() * l.rectified_from_raw;
  out.right_from_left.translation() = r.rectified_from_raw.transpose() * shift;
  return draft;
}

}  // namespace softscope
