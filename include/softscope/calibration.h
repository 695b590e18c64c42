// include/softscope/calibration.h: stereo calibration.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// Immutable; copies share the data.
class Calibration {
 public:
  /// Reads any file accepted by `softscope reconstruct --calibration`; lengths are converted
  /// to mm. `width_px`, `height_px`: of the images, if missing in the file. Throws InputError.
  static Calibration read(const std::string& file, int width_px = 0, int height_px = 0);

  /// Two equal cameras without distortion, with aligned rows. Throws OptionError.
  static Calibration rectified(int width_px, int height_px, double focal_px, double centre_u_px,
                               double centre_v_px, double baseline_mm);

  int widthPx() const;
  int heightPx() const;
  double baselineMm() const;
  std::vector<std::string> warnings() const;

  /// Implementation.
  struct Data;
  explicit Calibration(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace softscope::api
