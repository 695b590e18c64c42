// include/softscope/calibration.h: two cameras on one scope.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// Immutable; a copy shares the data.
class Calibration {
 public:
  /// From any of the files that `softscope reconstruct --calibration` takes; lengths become mm.
  /// `width_px`, `height_px`: of the images, where the file does not say it. Throws InputError.
  static Calibration read(const std::string& file, int width_px = 0, int height_px = 0);

  /// Two equal cameras without distortion whose rows are aligned. Throws OptionError.
  static Calibration rectified(int width_px, int height_px, double focal_px, double centre_u_px,
                               double centre_v_px, double baseline_mm);

  int widthPx() const;
  int heightPx() const;
  double baselineMm() const;
  std::vector<std::string> warnings() const;

  /// Of the implementation.
  struct Data;
  explicit Calibration(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace softscope::api
