// src/pipeline/cuda_backend.h: stereo, model view, matching, the pose's refinement and the warp's
// solver on the GPU, every other stage on the processor's cores.
#pragma once

#include <memory>
#include <string>

#include "core/stereo_rig.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"
#include "pipeline/stereo_stage.h"

namespace softscope {

/// Disparity, depth and normals on the first GPU; the bytes of makeCpuStereoStage(). Memory is
/// taken once, here. A pair with masked borders is left to the processor. Throws BackendError
/// without a GPU that runs this build or with too little memory, OptionError where an option has no
/// GPU version.
std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions& options,
                                                 const RectifiedRig& rig);

/// The model of makeCpuBackend() up to the rounding of pose and warp; the same run gives the same
/// bytes. Affine nodes are left to the processor. The next frame's depth is measured while the
/// processor works on this one. Throws as both do.
std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration& calibration,
                                                       const ReconstructionOptions& options);

}  // namespace softscope
