// cuda/pose/pose.h: the search for the scope's pose on the GPU.
#pragma once

#include <memory>

#include "pose/pose_search.h"

namespace softscope::cuda {

/// On the first GPU. More pairs than kernels hold are left to the processor. Throws BackendError
/// without a device that runs this build.
std::unique_ptr<PoseSearch> makePoseSearch();

}  // namespace softscope::cuda
