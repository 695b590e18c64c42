// toolkit/face/calibration.cpp: implementation of include/softscope/calibration.h.
#include "softscope/calibration.h"

#include "io/calibrations/calibration_check.h"
#include "io/calibrations/calibration_reader.h"
#include "toolkit/face/calibration_data.h"

namespace softscope::api {

Calibration Calibration::read(const std::string& file, int width_px, int height_px) {
  CalibrationHints hints;
  if (width_px != 0 || height_px != 0)
    hints.image_size = std::to_string(width_px) + "x" + std::to_string(height_px);
  return calibrationOf(readCalibration(file, hints));
}

Calibration Calibration::rectified(int width_px, int height_px, double focal_px, double centre_u_px,
                                   double centre_v_px, double baseline_mm) {
  require(width_px > 0, "width_px", width_px, "must be above 0");
  require(height_px > 0, "height_px", height_px, "must be above 0");
  StereoCalibration made;
  made.left.pinhole = {width_px, height_px, focal_px, focal_px, centre_u_px, centre_v_px};
  made.right = made.left;
  made.right_from_left.translation().x() = -baseline_mm;
  made.rectified = true;
  made.source = "calibration";
  made.warnings = checkCalibration(made);
  for (const std::string& warning : checkPictureFit(made)) made.warnings.push_back(warning);
  return calibrationOf(std::move(made));
}

int Calibration::widthPx() const { return data_->calibration.left.pinhole.width_px; }
int Calibration::heightPx() const { return data_->calibration.left.pinhole.height_px; }
double Calibration::baselineMm() const { return data_->calibration.baseline_mm(); }
std::vector<std::string> Calibration::warnings() const { return data_->calibration.warnings; }

}  // namespace softscope::api
