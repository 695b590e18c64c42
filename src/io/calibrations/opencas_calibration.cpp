// src/io/calibrations/opencas_calibration.cpp: OpenCAS
// texts, in one file that begins with RAT or in five files.
#include <cmath>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

// One camera in the single-file format: width height, camera matrix
// (9), k1 k2 p1 p2 k3 k4 k5 k6, rotation (9), translation (3).
constexpr std::size_t kNumbersPerCamera = 31;

struct OpenCasCamera {
  RawCamera camera;
  Eigen::Isometry3d camera_from_first = Eigen::Isometry3d::Identity();
};

std::vector<double> slice(const std::vector<double>& values, std::size_t begin, std::size_t count) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

OpenCasCamera cameraFrom(const NumberRow& row, const std::string& what) {
  if (row.values.size() != kNumbersPerCamera)
    throw InputError(say(what, " (line ", row.line, ") has ", row.values.size(), " numbers, but ",
                         kNumbersPerCamera, " are expected. Copy the file again."));
  OpenCasCamera out;
  out.camera.pinhole.width_px = wholePixels(row.values[0], 1, what + ": width");
  out.camera.pinhole.height_px = wholePixels(row.values[1], 1, what + ": height");
  setCameraMatrix(out.camera.pinhole, slice(row.values, 2, 9), what + ": camera matrix");
  out.camera.distortion = distortionFrom(slice(row.values, 11, 8), what + ": distortion");
  out.camera_from_first = poseFrom(slice(row.values, 19, 9), slice(row.values, 28, 3),
                                   what + ": rotation", what + ": translation");
  return out;
}

std::vector<double> numbersAlone(const NamedText& file) {
  std::vector<double> all;
  for (const NumberRow& row : numberRows(file.text))
    all.insert(all.end(), row.values.begin(), row.values.end());
  return all;
}

RawCamera cameraFrom(const NamedText& intrinsics, const NamedText& distortion) {
  RawCamera out;
  setCameraMatrix(out.pinhole, numbersAlone(intrinsics), intrinsics.name);
  const std::vector<double> coefficients = numbersAlone(distortion);
  if (coefficients.empty())
    throw InputError(distortion.name + ": holds no numbers, but 5 or 8 are expected.");
  out.distortion = distortionFrom(coefficients, distortion.name);
  return out;
}

}  // namespace

CalibrationDraft draftFromOpenCas(const NamedText& file) {
  const std::vector<NumberRow> rows = numberRows(file.text);
  if (rows.size() < 3 || rows[0].values.size() != 1 || rows[0].values[0] != 2)
    throw InputError(file.name + ": after RAT, `2` cameras and a line for each are expected.");
  const OpenCasCamera left = cameraFrom(rows[1], file.name + ": left camera");
  const OpenCasCamera right = cameraFrom(rows[2], file.name + ": right camera");
  CalibrationDraft draft;
  draft.calibration.form = kOpenCasForm;
  draft.calibration.left = left.camera;
  draft.calibration.right = right.camera;
  draft.calibration.right_from_left = right.camera_from_first * left.camera_from_first.inverse();
  return draft;
}

CalibrationDraft draftFromOpenCas(const OpenCasFiles& files) {
  const std::vector<double> pose = numbersAlone(files.left_to_right);
  if (pose.size() != 16 && pose.size() != 12)
    throw InputError(say(files.left_to_right.name, ": has ", pose.size(),
                         " numbers, but a 4 x 4 transform from left to right is expected."));
  CalibrationDraft draft;
  StereoCalibration& out = draft.calibration;
  out.form = kOpenCasForm;
  out.left = cameraFrom(files.left_intrinsics, files.left_distortion);
  out.right = cameraFrom(files.right_intrinsics, files.right_distortion);
  const std::string& name = files.left_to_right.name;
  out.right_from_left =
      poseFrom({pose[0], pose[1], pose[2], pose[4], pose[5], pose[6], pose[8], pose[9], pose[10]},
               {pose[3], pose[7], pose[11]}, name + ": rotation", name + ": translation");
  if (!isRational(out.left.distortion) || !isRational(out.right.distortion))
    out.warnings.push_back(
        files.left_distortion.name +
        ": has k1 k2 p1 p2 k3 alone, but OpenCAS calibrations are of the rational "
        "model with k4 k5 k6 beside; depth will be biased. Use the one-file form "
        "(…_Calibration.txt).");
  return draft;
}

}  // namespace softscope
