// src/io/calibrations/opencv_calibration.cpp: names
// of stereoCalibrate in any document; also SCARED.
#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/calibrations/misspelt_key.h"
#include "io/calibrations/one_camera.h"
#include "io/documents/number_tree.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

// Alternative names of the same value; errors mention the first.
using Aliases = std::vector<std::string_view>;
const Aliases kLeftMatrix = {"M1",
                             "K1",
                             "cameraMatrix1",
                             "camera_matrix_1",
                             "KL",
                             "left_camera_matrix",
                             "camera_matrix_left",
                             "K_left",
                             "leftcameramat"};
const Aliases kRightMatrix = {"M2",
                              "K2",
                              "cameraMatrix2",
                              "camera_matrix_2",
                              "KR",
                              "right_camera_matrix",
                              "camera_matrix_right",
                              "K_right",
                              "rightcameramat"};
const Aliases kLeftDistortion = {"D1",
                                 "distCoeffs1",
                                 "dist_coeffs_1",
                                 "distortion_coefficients_1",
                                 "DL",
                                 "left_distortion",
                                 "dist_coeffs_left",
                                 "D_left",
                                 "leftdistortioncoeffs"};
const Aliases kRightDistortion = {"D2",
                                  "distCoeffs2",
                                  "dist_coeffs_2",
                                  "distortion_coefficients_2",
                                  "DR",
                                  "right_distortion",
                                  "dist_coeffs_right",
                                  "D_right",
                                  "rightdistortioncoeffs"};
const Aliases kRotation = {"R", "rotation_matrix", "rotation", "R_left_to_right"};
const Aliases kTranslation = {"T", "translation_vector", "translation", "t_left_to_right"};
const Aliases kOneMatrix = {"M1", "K", "M", "camera_matrix", "cameraMatrix", "K1"};
const Aliases kOneDistortion = {"D1", "D", "distortion_coefficients", "distCoeffs"};
const Aliases kFocal = {"f", "fx", "focal", "focal_px", "f_px"};
const Aliases kFocalDown = {"fy"};
const Aliases kCentreU = {"cx", "cx_px"};
const Aliases kCentreV = {"cy", "cy_px"};
const Aliases kCentreURight = {"cx_right"};
const Aliases kBaseline = {"baseline", "baseline_mm"};
const Aliases kWidth = {"image_width", "imageWidth", "width"};
const Aliases kHeight = {"image_height", "imageHeight", "height"};
const Aliases kSize = {"image_size", "imageSize", "img_size"};
const Aliases kUnit = {"unit", "units"};
const Aliases kRectified = {"rectified"};
const Aliases kDepthUnit = {"depth_unit_mm"};

/// All names of a calibration.
Aliases knownNames() {
  Aliases all;
  for (const Aliases& names :
       {kLeftMatrix,  kRightMatrix, kLeftDistortion, kRightDistortion, kRotation,
        kTranslation, kOneMatrix,   kOneDistortion,  kFocal,           kFocalDown,
        kCentreU,     kCentreV,     kCentreURight,   kBaseline,        kWidth,
        kHeight,      kSize,        kUnit,           kRectified,       kDepthUnit})
    all.insert(all.end(), names.begin(), names.end());
  return all;
}

/// Access to one or two documents.
class Members {
 public:
  Members(const std::vector<Document>& documents, std::string name)
      : documents_(documents), name_(std::move(name)) {}

  const Document* find(const Aliases& names) const {
    for (const std::string_view name : names)
      for (const Document& document : documents_)
        if (const Document* found = document.find(name)) return found;
    return nullptr;
  }
  std::string label(const Aliases& names) const { return say(name_, ": ", names.front()); }

  std::vector<double> numbers(const Aliases& names) const {
    const Document* found = find(names);
    if (!found)
      throw InputError(
          say(label(names), " is missing, but a stereo calibration has M1, D1, M2, D2,",
              " R and T. Write them as stereoCalibrate names them.", misspelt(names, " ")));
    return numbersOf(*found, label(names));
  }
  std::vector<double> numbersIfAny(const Aliases& names) const {
    return find(names) ? numbers(names) : std::vector<double>{};
  }

  /// Sentence about a misspelt key after `before`; empty if there is none.
  std::string misspelt(const Aliases& names, const std::string& before) const {
    const std::string found = misspeltKey(documents_, names, knownNames());
    return found.empty() ? found : before + found;
  }
  /// One warning per value that is absent, with a key that resembles its names.
  void warnOfMisspelt(const std::vector<Aliases>& values,
                      std::vector<std::string>& warnings) const {
    for (const Aliases& names : values) {
      if (find(names)) continue;
      const std::string warning = misspelt(names, name_ + ": ");
      if (!warning.empty()) warnings.push_back(warning);
    }
  }
  std::string unreadLens() const { return unreadLensKeys(documents_, knownNames()); }

 private:
  const std::vector<Document>& documents_;
  std::string name_;
};

double singleNumber(const Members& members, const Aliases& names) {
  const std::vector<double> values = members.numbers(names);
  if (values.size() != 1)
    throw InputError(
        say(members.label(names), " has ", values.size(), " numbers, but one is expected."));
  return values[0];
}

void setSize(const Members& members, StereoCalibration& out) {
  int width_px = 0, height_px = 0;
  if (members.find(kWidth) && members.find(kHeight)) {
    width_px = wholePixels(singleNumber(members, kWidth), 0, members.label(kWidth));
    height_px = wholePixels(singleNumber(members, kHeight), 0, members.label(kHeight));
  } else if (members.find(kSize)) {
    const std::vector<double> size = members.numbers(kSize);
    if (size.size() != 2) throw InputError(members.label(kSize) + " must be width and height.");
    width_px = wholePixels(size[0], 0, members.label(kSize));
    height_px = wholePixels(size[1], 0, members.label(kSize));
  }
  out.left.pinhole.width_px = out.right.pinhole.width_px = width_px;
  out.left.pinhole.height_px = out.right.pinhole.height_px = height_px;
}

void setFlags(const Members& members, CalibrationDraft& draft) {
  if (const Document* unit = members.find(kUnit)) draft.unit = unit->text;
  if (const Document* flag = members.find(kRectified)) {
    const std::string text = lowerCase(flag->text);
    if (text != "0" && text != "1" && text != "true" && text != "false")
      throw InputError(
          say(members.label(kRectified), " is ", excerpt(text), ", but 0 or 1 is expected."));
    draft.calibration.rectified = text == "1" || text == "true";
  }
  if (members.find(kDepthUnit)) draft.calibration.depth_unit_mm = singleNumber(members, kDepthUnit);
}

/// Errors mention the names of the short format.
double shortNumber(const Members& members, const Aliases& names) {
  if (!members.find(names))
    throw InputError(
        say(members.label(names),
            " is missing, but a short calibration has f (or fx and fy), cx and cy, and "
            "baseline for a rectified pair. `softscope calibration-template` writes "
            "one of each kind.",
            members.misspelt(names, " ")));
  return singleNumber(members, names);
}

void setOneCamera(const Members& members, RawCamera& camera) {
  if (members.find(kFocal)) {
    const double fx_px = shortNumber(members, kFocal);
    const double fy_px = members.find(kFocalDown) ? shortNumber(members, kFocalDown) : fx_px;
    const double cx_px = shortNumber(members, kCentreU), cy_px = shortNumber(members, kCentreV);
    setCameraMatrix(camera.pinhole, {fx_px, 0, cx_px, 0, fy_px, cy_px, 0, 0, 1},
                    members.label(kFocal) + ", cx or cy");
    return;
  }
  setCameraMatrix(camera.pinhole, members.numbers(kOneMatrix), members.label(kOneMatrix));
  camera.distortion =
      distortionFrom(members.numbersIfAny(kOneDistortion), members.label(kOneDistortion));
}

/// Pinholes with the same focal length and principal row, side by side: resampling would only blur.
bool isRectified(const StereoCalibration& pair) {
  const PinholeCamera &left = pair.left.pinhole, &right = pair.right.pinhole;
  const Eigen::Vector3d t = pair.right_from_left.translation();
  return pair.left.distortion.isZero() && pair.right.distortion.isZero() &&
         pair.right_from_left.linear().isIdentity(1e-9) && left.fx_px == left.fy_px &&
         left.fx_px == right.fx_px && left.fy_px == right.fy_px && left.cy_px == right.cy_px &&
         std::hypot(t.y(), t.z()) <= 1e-9 * std::abs(t.x());
}

}  // namespace

bool holdsFewNumbers(const std::vector<Document>& documents) {
  const Members members(documents, "");
  if (members.find(kRightMatrix) || members.find(kRotation) || members.find(kTranslation))
    return false;
  return members.find(kFocal) || members.find(kOneMatrix);
}

CalibrationDraft draftFromFewNumbers(const std::vector<Document>& documents,
                                     const std::string& name) {
  const Members members(documents, name);
  CalibrationDraft draft;
  StereoCalibration& out = draft.calibration;
  setOneCamera(members, out.left);
  out.right = out.left;
  const bool pair = members.find(kBaseline) != nullptr;
  out.form = pair ? "rectified pair" : kOneCameraForm;
  out.rectified = out.left.distortion.isZero();
  setFlags(members, draft);
  setSize(members, out);
  if (members.find(kCentreURight)) {
    const PinholeCamera& left = out.left.pinhole;
    setCameraMatrix(
        out.right.pinhole,
        {left.fx_px, 0, singleNumber(members, kCentreURight), 0, left.fy_px, left.cy_px, 0, 0, 1},
        members.label(kCentreURight));
  }
  double baseline = kAssumedBaselineMm;
  if (pair) baseline = shortNumber(members, kBaseline);
  if (!pair || members.find({"baseline_mm"})) draft.unit = "mm";
  out.right_from_left.translation().x() = -baseline;
  members.warnOfMisspelt({kOneDistortion, kFocalDown, kCentreURight, kBaseline, kWidth, kHeight,
                          kSize, kUnit, kRectified, kDepthUnit},
                         out.warnings);
  if (const std::string lens = members.unreadLens(); !lens.empty() && !members.find(kOneDistortion))
    out.warnings.push_back(say(name, ": the lens is taken to be without distortion; ", lens,
                               " is not read. Write M1 and D1."));
  return draft;
}

StereoCalibration uncalibrated(int width_px, int height_px) {
  StereoCalibration out;
  PinholeCamera& camera = out.left.pinhole;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = width_px;
  camera.cx_px = 0.5 * (width_px - 1);
  camera.cy_px = 0.5 * (height_px - 1);
  out.right = out.left;
  out.right_from_left.translation().x() = -kAssumedBaselineMm;
  out.rectified = true;
  out.form = kUncalibratedForm;
  out.source = "no calibration";
  return out;
}

CalibrationDraft draftFromOpenCv(const std::vector<Document>& documents, const std::string& name) {
  const Members members(documents, name);
  CalibrationDraft draft;
  StereoCalibration& out = draft.calibration;
  out.form = "OpenCV";
  setSize(members, out);
  setCameraMatrix(out.left.pinhole, members.numbers(kLeftMatrix), members.label(kLeftMatrix));
  setCameraMatrix(out.right.pinhole, members.numbers(kRightMatrix), members.label(kRightMatrix));
  out.left.distortion =
      distortionFrom(members.numbersIfAny(kLeftDistortion), members.label(kLeftDistortion));
  out.right.distortion =
      distortionFrom(members.numbersIfAny(kRightDistortion), members.label(kRightDistortion));
  out.right_from_left = poseFrom(members.numbers(kRotation), members.numbers(kTranslation),
                                 members.label(kRotation), members.label(kTranslation));
  if (members.find({"K_left", "leftcameramat"})) {  // formats of STIR are in metres
    out.form = members.find({"K_left"}) ? "STIR 2026" : "STIR";
    draft.unit = "m";
    out.rectified = isRectified(out);
  }
  setFlags(members, draft);
  members.warnOfMisspelt(
      {kLeftDistortion, kRightDistortion, kWidth, kHeight, kSize, kUnit, kRectified, kDepthUnit},
      out.warnings);
  if (!out.rectified && (!members.find(kLeftDistortion) || !members.find(kRightDistortion))) {
    const std::string lens = members.unreadLens();
    out.warnings.push_back(say(name,
                               ": D1 or D2 is missing; the lens is taken to be without distortion.",
                               lens.empty() ? "" : " Not read: " + lens + ". Write D1 and D2."));
  }
  return draft;
}

}  // namespace softscope
