// src/pipeline/backends.h: what this build, on this machine, can compute on.
#pragma once

#include "cuda/device_info.h"

namespace softscope {

/// The GPUs and CUDA versions found; `why_none` also says so if this build has no CUDA at all.
/// Never throws. Takes up to a second: the driver wakes each GPU.
cuda::DeviceInfo cudaDevices();

}  // namespace softscope
