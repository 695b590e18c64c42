// cuda/pose/pose.h: search for the camera pose on the GPU.
#pragma once

#include <memory>

#include "pose/pose_search.h"

namespace softscope::cuda {

/// On the first GPU. Too many pairs for the kernels are processed
/// by the CPU. Throws BackendError without a suitable device.
std::unique_ptr<PoseSearch> makePoseSearch();

}  // namespace softscope::cuda
