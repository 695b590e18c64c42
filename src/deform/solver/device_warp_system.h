// src/deform/solver/device_warp_system.h: least-squares problem of one frame on a
// device.
#pragma once

#include <memory>

#include "deform/options/deform_options.h"
#include "deform/solver/warp_device.h"
#include "deform/solver/warp_system.h"

namespace softscope {

/// For rigid nodes and targets from a DepthTarget (or none). Same energy as
/// makeCpuWarpSystem() up to rounding. Throws OptionError for affine nodes.
std::unique_ptr<WarpSystem> makeDeviceWarpSystem(const DeformOptions& options,
                                                 std::unique_ptr<WarpDevice> device);

}  // namespace softscope
