// src/io/calibrations/projection_calibration.cpp: projection matrices of SERV-CT for rectified
// cameras.
#include <cmath>

#include "core/error.h"
#include "io/calibrations/calibration_forms.h"
#include "io/calibrations/calibration_parts.h"
#include "io/documents/number_tree.h"
#include "io/text/message.h"

namespace softscope {
namespace {

struct Projection {
  PinholeCamera camera;
  double shift_mm = 0;  // translation of the point before projection
};

Projection projectionOf(const Document& document, const char* key, const std::string& name) {
  const std::string what = say(name, ": ", key);
  const std::vector<double> p = numbersOf(*document.find(key), what);
  if (p.size() != 12)
    throw InputError(say(what, " has ", p.size(), " numbers, but a 3 x 4 matrix is expected."));
  Projection out;
  setCameraMatrix(out.camera, {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]}, what);
  out.shift_mm = p[3] / p[0];
  return out;
}

}  // namespace

CalibrationDraft draftFromProjections(const Document& document, const std::string& name) {
  const Projection left = projectionOf(document, "P1", name);
  const Projection right = projectionOf(document, "P2", name);
  CalibrationDraft draft;
  StereoCalibration& out = draft.calibration;
  out.form = "SERV-CT";
  out.rectified = true;
  out.left.pinhole = left.camera;
  out.right.pinhole = right.camera;
  // The sign differs between exports of P2; the right camera is on the right.
  const double baseline_mm = std::abs(right.shift_mm - left.shift_mm);
  if (!std::isfinite(baseline_mm) || baseline_mm == 0)
    throw InputError(name + ": P2 has no baseline in its fourth column, but -fx * B is expected.");
  out.right_from_left.translation().x() = -baseline_mm;
  return draft;
}

}  // namespace softscope
