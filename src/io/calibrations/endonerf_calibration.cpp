// src/io/calibrations/endonerf_calibration.cpp: poses_bounds.npy
// of EndoNeRF, without baseline and principal point.
#include <cmath>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/documents/npy_file.h"
#include "io/text/message.h"

namespace softscope {
namespace {

// A row is a 3 x 5 matrix (pose; height, width, focal length in the
// fifth column), row-major, and near and far bounds, which are optional.
constexpr std::size_t kHeightColumn = 4, kWidthColumn = 9, kFocalColumn = 14;

void requireOneCamera(const NpyArray& poses, const std::string& name) {
  for (std::size_t row = 1; row < poses.rows; ++row)
    for (const std::size_t column : {kHeightColumn, kWidthColumn, kFocalColumn}) {
      const double first = poses.values[column];
      const double here = poses.values[row * poses.columns + column];
      if (!(std::abs(here - first) <= 1e-6 * std::abs(first)))
        throw InputError(say(name, ": row ", row, " is of another camera (", here, " against ",
                             first, " in column ", column, "), but one rig is expected."));
    }
}

}  // namespace

CalibrationDraft draftFromEndoNerf(std::string_view npy, const std::string& name) {
  const NpyArray poses = parseNpy(npy, name);
  if (poses.columns != 17 && poses.columns != 15)
    throw InputError(say(name, ": has ", poses.columns,
                         " columns, but poses_bounds.npy has 17 (or 15 without bounds)."));
  requireOneCamera(poses, name);
  PinholeCamera camera;
  camera.width_px = wholePixels(poses.values[kWidthColumn], 1, name + ": width");
  camera.height_px = wholePixels(poses.values[kHeightColumn], 1, name + ": height");
  camera.fx_px = camera.fy_px = poses.values[kFocalColumn];
  camera.cx_px = camera.width_px / 2.0;
  camera.cy_px = camera.height_px / 2.0;
  CalibrationDraft draft;
  draft.has_baseline = false;
  draft.calibration.form = "EndoNeRF";
  draft.calibration.rectified = true;
  draft.calibration.left.pinhole = draft.calibration.right.pinhole = camera;
  return draft;
}

}  // namespace softscope
