// cuda/comparison.h: comparison of model and frame on the first GPU.
#pragma once

#include <memory>

#include "core/camera.h"
#include "fusion/frame_comparer.h"

namespace softscope::cuda {

/// Throws BackendError where no GPU works.
std::unique_ptr<FrameComparer> makeFrameComparer(const PinholeCamera& left);

}  // namespace softscope::cuda
