// src/pipeline/backends.h: back ends available in this build on this machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "cuda/device/device_info.h"
#include "pipeline/frame_depth.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// The GPUs and CUDA versions found; `why_none` also says so if this build has no CUDA at all.
/// Never throws. Takes up to a second: the driver starts each GPU.
cuda::DeviceInfo cudaDevices();

/// Why no kernel of this build runs on this machine; empty: they do.
std::string whyNoCuda();

/// "cpu" and, where CUDA was built, "cuda", with or without a GPU.
std::vector<std::string> builtBackends();

/// Throws OptionError unless `name` is auto, cpu or cuda.
void requireBackendName(const std::string& name);

/// A back end or a stage of it, and the reason of the choice.
template <class Part>
struct Chosen {
  Part part;
  std::string name;  // "cpu" or "cuda"
  std::string why;   // of auto's choice; empty where it was named
};

/// `auto` takes the GPU where one runs this build, has the memory, and the depth comes from a
/// method that has kernels; a frame then takes less time (docs/benchmarks.md). `cuda` throws
/// BackendError, or OptionError for such a method, instead of taking the processor.
Chosen<std::unique_ptr<ReconstructionBackend>> makeBackend(const std::string& name,
                                                           const StereoCalibration& calibration,
                                                           const ReconstructionOptions& options);

/// Stage 1 alone, chosen alike.
Chosen<std::unique_ptr<FrameDepth>> makeFrameDepth(const std::string& name,
                                                   const StereoCalibration& calibration,
                                                   const FrameDepthOptions& options);

}  // namespace softscope
