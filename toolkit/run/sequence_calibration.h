// toolkit/run/sequence_calibration.h: calibration of a sequence folder.
#pragma once

#include <filesystem>

#include "core/stereo_rig.h"

namespace softscope {

/// If the file has no image size, it is
/// taken from the images. Throws InputError.
StereoCalibration sequenceCalibration(const std::filesystem::path& sequence);

}  // namespace softscope
