// src/io/calibrations/hamlyn_calibration.cpp: Hamlyn texts, rows of numbers without names.
#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr std::size_t kRowsPerBlock = 4;
using Rows = std::vector<NumberRow>;

/// Three rows of three numbers, concatenated.
std::vector<double> matrixOf(const Rows& rows, std::size_t begin, const std::string& what) {
  std::vector<double> out;
  for (std::size_t i = begin; i < begin + 3; ++i) {
    if (rows[i].values.size() != 3)
      throw InputError(say(what, ": line ", rows[i].line, " has ", rows[i].values.size(),
                           " numbers, but 3 are expected (a row of a 3 x 3 matrix)."));
    out.insert(out.end(), rows[i].values.begin(), rows[i].values.end());
  }
  return out;
}

RawCamera cameraFrom(const Rows& rows, std::size_t begin, const std::string& what) {
  RawCamera out;
  setCameraMatrix(out.pinhole, matrixOf(rows, begin, what), what + ": camera matrix");
  out.distortion = distortionFrom(rows[begin + 3].values, what + ": distortion");
  return out;
}

Eigen::Isometry3d poseFromRows(const Rows& rows, std::size_t begin, const std::string& what) {
  return poseFrom(matrixOf(rows, begin, what), rows[begin + 3].values, what + ": rotation",
                  what + ": translation");
}

Rows rowsOf(const NamedText& file, std::size_t expected, const char* meaning) {
  Rows rows = numberRows(file.text);
  if (rows.size() != expected)
    throw InputError(say(file.name, ": has ", rows.size(), " lines of numbers, but ", expected,
                         " are expected: ", meaning, "."));
  return rows;
}

}  // namespace

CalibrationDraft draftFromHamlyn(const HamlynFiles& files) {
  const char* camera = "a 3 x 3 camera matrix, then k1 k2 p1 p2";
  const char* pose = "a 3 x 3 rotation, then the translation";
  CalibrationDraft draft;
  draft.calibration.form = "Hamlyn";
  draft.calibration.left =
      cameraFrom(rowsOf(files.left, kRowsPerBlock, camera), 0, files.left.name);
  draft.calibration.right =
      cameraFrom(rowsOf(files.right, kRowsPerBlock, camera), 0, files.right.name);
  draft.calibration.right_from_left =
      poseFromRows(rowsOf(files.extrinsics, kRowsPerBlock, pose), 0, files.extrinsics.name);
  return draft;
}

CalibrationDraft draftFromHamlyn(const NamedText& file) {
  const Rows rows =
      rowsOf(file, 3 * kRowsPerBlock,
             "left camera matrix and k1 k2 p1 p2, the same of the right, rotation and translation");
  CalibrationDraft draft;
  draft.calibration.form = "Hamlyn";
  draft.calibration.left = cameraFrom(rows, 0, file.name + ": left");
  draft.calibration.right = cameraFrom(rows, kRowsPerBlock, file.name + ": right");
  draft.calibration.right_from_left = poseFromRows(rows, 2 * kRowsPerBlock, file.name);
  return draft;
}

}  // namespace softscope
