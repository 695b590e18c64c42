// src/pipeline/backends.h: back ends available in this build on this machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "cuda/device/device_info.h"
#include "pipeline/frame/frame_depth.h"
#include "pipeline/options/reconstruction_options.h"
#include "pipeline/reconstruction_backend.h"

namespace softscope {

/// GPUs and CUDA versions; `why_none` is also set for a build without CUDA.
/// Never throws. Takes up to a second: the driver initialises each GPU.
cuda::DeviceInfo cudaDevices();

/// Reason why no kernel of this build runs on this machine; empty: they run.
std::string cudaUnavailableReason();

/// "cpu" and, in a build with CUDA, "cuda", with or without a GPU.
std::vector<std::string> builtBackends();

/// Throws OptionError unless `name` is auto, cpu or cuda.
void requireBackendName(const std::string& name);

/// Back end or stage, with the reason of the choice.
template <class Part>
struct Chosen {
  Part part;
  std::string name;  // for auto; empty if it was named
  std::string why;   // of auto's choice; empty where it was named
};

/// `auto` selects the GPU if one runs this build, has enough memory, and the method
/// of depth has kernels; a frame then takes less time (docs/benchmarks.md). `cuda`
/// throws BackendError, or OptionError for such a method, instead of using the CPU.
Chosen<std::unique_ptr<ReconstructionBackend>> makeBackend(const std::string& name,
                                                           const StereoCalibration& calibration,
                                                           const ReconstructionOptions& options);

/// Stage 1 only, with the same choice.
Chosen<std::unique_ptr<FrameDepth>> makeFrameDepth(const std::string& name,
                                                   const StereoCalibration& calibration,
                                                   const FrameDepthOptions& options);

}  // namespace softscope
