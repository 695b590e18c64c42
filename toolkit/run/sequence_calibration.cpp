// toolkit/run/sequence_calibration.cpp: image size from the first frame.
#include "toolkit/run/sequence_calibration.h"

#include "core/error.h"
#include "io/calibrations/calibration_reader.h"
#include "io/sequences/sequence_reader.h"

namespace softscope {

StereoCalibration sequenceCalibration(const std::filesystem::path& sequence) {
  const StereoCalibration calibration = readCalibration(sequence);
  if (calibration.left.pinhole.width_px > 0) return calibration;
  try {
    return SequenceReader(sequence).calibration();
  } catch (const InputError&) {  // ground truth without images
    return calibration;
  }
}

}  // namespace softscope
