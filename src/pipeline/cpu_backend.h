// src/pipeline/cpu_backend.h: every stage on the processor's cores.
#pragma once

#include <memory>

#include "core/stereo_rig.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// Same input, same bytes, whatever the number of threads.
/// Throws OptionError for bad options, InputError where the calibration can't be used.
std::unique_ptr<ReconstructionBackend> makeCpuBackend(const StereoCalibration& calibration,
                                                      const ReconstructionOptions& options);

}  // namespace softscope
