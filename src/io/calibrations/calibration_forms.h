// src/io/calibrations/calibration_forms.h: parsers of each calibration format; values are
// unchecked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/stereo_rig.h"
#include "io/documents/document.h"

namespace softscope {

/// A calibration as its file has it: lengths still in the file's unit.
struct CalibrationDraft {
  StereoCalibration calibration;
  std::string unit = "mm";   // of right_from_left's translation
  bool has_baseline = true;  // false: the form leaves it out
};

/// A file's content and what messages call it.
struct NamedText {
  std::string name;
  std::string_view text;
};

// All throw InputError. Which numbers each accepts: docs/formats.md.

/// stereoCalibrate's names M1 D1 M2 D2 R T, or their usual aliases. `documents`: one, or the two
/// that OpenCV's sample writes (intrinsics, extrinsics). SCARED's files are of this form as well.
CalibrationDraft draftFromOpenCv(const std::vector<Document>& documents, const std::string& name);

/// Few numbers: f (or fx and fy), cx, cy, and baseline where the images are a rectified pair;
/// without it they are one camera's, as is a file with M1 alone.
CalibrationDraft draftFromFewNumbers(const std::vector<Document>& documents,
                                     const std::string& name);
bool holdsFewNumbers(const std::vector<Document>& documents);

/// Whether it is one camera's camera_info of ROS.
bool isCameraInfo(const Document& document);

/// ROS camera_info of both cameras. `rectified`: the images are image_rect, so the projection
/// matrices count.
CalibrationDraft draftFromRos(const Document& left, const Document& right, const std::string& name,
                              bool rectified);

/// OpenCAS in one file, which begins with `RAT`.
CalibrationDraft draftFromOpenCas(const NamedText& file);

struct OpenCasFiles {
  NamedText left_intrinsics, left_distortion, right_intrinsics, right_distortion, left_to_right;
};
CalibrationDraft draftFromOpenCas(const OpenCasFiles& files);

/// SERV-CT: the projection matrices P1 and P2 of rectified cameras, mm.
CalibrationDraft draftFromProjections(const Document& document, const std::string& name);

/// StereoMIS: [StereoLeft] and [StereoRight] with fc_x fc_y cc_x cc_y kc_0 … and, of the right one,
/// R_0 … R_8, T_0 … T_2 (mm). Any INI of that form.
CalibrationDraft draftFromIni(std::string_view text, const std::string& name);

struct HamlynFiles {
  NamedText left, right, extrinsics;
};
CalibrationDraft draftFromHamlyn(const HamlynFiles& files);
/// The three blocks of numbers in one file.
CalibrationDraft draftFromHamlyn(const NamedText& file);

/// LLFF's poses_bounds.npy; says neither baseline nor principal point (the image's middle).
CalibrationDraft draftFromEndoNerf(std::string_view npy, const std::string& name);

}  // namespace softscope
