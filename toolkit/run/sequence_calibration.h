// toolkit/run/sequence_calibration.h: the calibration of a sequence folder.
#pragma once

#include <filesystem>

#include "core/stereo_rig.h"

namespace softscope {

/// With the size of the images where the file leaves it out and there are images. Throws
/// InputError.
StereoCalibration sequenceCalibration(const std::filesystem::path& sequence);

}  // namespace softscope
