// cuda/warp/warp.h: least-squares problem of the warp on the GPU.
#pragma once

#include <memory>

#include "cuda/device/shared_rasters.h"
#include "cuda/model/shared_model.h"
#include "deform/solver/warp_device.h"

namespace softscope::cuda {

/// On the first GPU. Throws BackendError without a suitable device.
std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights,
                                           std::shared_ptr<const SharedRasters> shared = nullptr,
                                           std::shared_ptr<SharedModel> model = nullptr);

}  // namespace softscope::cuda
