// src/io/calibrations/calibration_forms.h: parsers of
// all calibration formats, without checks of values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/stereo_rig.h"
#include "io/documents/document.h"

namespace softscope {

/// Calibration as in its file: lengths in the unit of the file.
struct CalibrationDraft {
  StereoCalibration calibration;
  std::string unit = "mm";   // of the translation of right_from_left
  bool has_baseline = true;  // false: the format has no baseline
};

/// Content of a file with its name for messages.
struct NamedText {
  std::string name;
  std::string_view text;
};

// All throw InputError. Accepted numbers: docs/formats.md.

/// Names of stereoCalibrate M1 D1 M2 D2 R T, or common aliases. `documents`: one, or
/// the two of OpenCV's sample (intrinsics, extrinsics). SCARED has this format too.
CalibrationDraft draftFromOpenCv(const std::vector<Document>& documents, const std::string& name);

/// Short format: f (or fx and fy), cx, cy, and baseline for a
/// rectified pair; without baseline, or with M1 only, a single camera.
CalibrationDraft draftFromFewNumbers(const std::vector<Document>& documents,
                                     const std::string& name);
bool holdsFewNumbers(const std::vector<Document>& documents);

/// True for camera_info of ROS (one camera).
bool isCameraInfo(const Document& document);

/// camera_info of ROS for both cameras. `rectified`: the
/// images are image_rect, so the projection matrices are used.
CalibrationDraft draftFromRos(const Document& left, const Document& right, const std::string& name,
                              bool rectified);

/// OpenCAS in one file that begins with `RAT`.
CalibrationDraft draftFromOpenCas(const NamedText& file);

struct OpenCasFiles {
  NamedText left_intrinsics, left_distortion, right_intrinsics, right_distortion, left_to_right;
};
CalibrationDraft draftFromOpenCas(const OpenCasFiles& files);

/// SERV-CT: the projection matrices P1 and P2 of rectified cameras, mm.
CalibrationDraft draftFromProjections(const Document& document, const std::string& name);

/// StereoMIS: [StereoLeft] and [StereoRight] with fc_x fc_y cc_x cc_y kc_0 … and,
/// for the right camera, R_0 … R_8, T_0 … T_2 (mm). Any INI file of this structure.
CalibrationDraft draftFromIni(std::string_view text, const std::string& name);

struct HamlynFiles {
  NamedText left, right, extrinsics;
};
CalibrationDraft draftFromHamlyn(const HamlynFiles& files);
/// Three blocks of numbers in one file.
CalibrationDraft draftFromHamlyn(const NamedText& file);

/// poses_bounds.npy of LLFF, without baseline and principal point (assumed in the image centre).
CalibrationDraft draftFromEndoNerf(std::string_view npy, const std::string& name);

}  // namespace softscope
