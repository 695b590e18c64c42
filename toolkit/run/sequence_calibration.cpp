// toolkit/run/sequence_calibration.cpp: image size from the first frame.
#include "toolkit/run/sequence_calibration.h"

#include "core/error.h"
#include "io/calibrations/calibration_reader.h"
#include "io/sequences/sequence_reader.h"

namespace softscope {
namespace {

/// In the form of a data set, whose calibration may be outside of the folder.
bool isDatasetClip(const std::filesystem::path& sequence) {
  try {
    return !findSequence(sequence).form.empty();
  } catch (const InputError&) {  // ground truth without images
    return false;
  }
}

}  // namespace

StereoCalibration sequenceCalibration(const std::filesystem::path& sequence) {
  if (isDatasetClip(sequence)) return SequenceReader(sequence).calibration();
  const StereoCalibration calibration = readCalibration(sequence);
  if (calibration.left.pinhole.width_px > 0) return calibration;
  try {
    return SequenceReader(sequence).calibration();
  } catch (const InputError&) {  // ground truth without images
    return calibration;
  }
}

}  // namespace softscope
