// src/pipeline/cuda_backend.h: stereo, model view, matching, pose refinement and warp solver on the
// GPU, other stages on the CPU.
#pragma once

#include <memory>
#include <string>

#include "core/stereo_rig.h"
#include "pipeline/frame/stereo_stage.h"
#include "pipeline/options/reconstruction_options.h"
#include "pipeline/reconstruction_backend.h"

namespace softscope {

/// Disparity, depth and normals on the first GPU; the bytes of
/// makeCpuStereoStage(). Memory is allocated here. A pair with masked borders
/// is processed by the CPU. Throws BackendError without a suitable GPU or
/// with too little memory, OptionError for an option without GPU version.
std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions& options,
                                                 const RectifiedRig& rig);

/// The model of makeCpuBackend() up to rounding of pose and warp;
/// deterministic. Affine nodes are processed by the CPU. The depth of the
/// next frame is computed while the CPU works on this one. Throws as both do.
std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration& calibration,
                                                       const ReconstructionOptions& options);

}  // namespace softscope
