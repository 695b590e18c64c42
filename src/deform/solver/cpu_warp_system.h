// src/deform/solver/cpu_warp_system.h: least-squares problem of one frame on the
// CPU.
#pragma once

#include <memory>

#include "deform/options/deform_options.h"
#include "deform/solver/warp_system.h"

namespace softscope {

std::unique_ptr<WarpSystem> makeCpuWarpSystem(const DeformOptions& options);

}  // namespace softscope
