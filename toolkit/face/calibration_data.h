// toolkit/face/calibration_data.h: content of a Calibration of the public interface.
#pragma once

#include <memory>

#include "core/stereo_rig.h"
#include "softscope/calibration.h"

namespace softscope::api {

struct Calibration::Data {
  StereoCalibration calibration;
};

inline Calibration calibrationOf(StereoCalibration calibration) {
  return Calibration(
      std::make_shared<const Calibration::Data>(Calibration::Data{std::move(calibration)}));
}

}  // namespace softscope::api
