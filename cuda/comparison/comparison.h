// cuda/comparison/comparison.h: comparison of model and frame on the first GPU.
#pragma once

#include <memory>

#include "core/camera.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/model/shared_model.h"
#include "fusion/frame_comparer.h"

namespace softscope::cuda {

/// `shared`: what rasters lie on the device already; `model`: ComparisonRun::share(). Both
/// may be null. Throws BackendError where no GPU works.
std::unique_ptr<FrameComparer> makeFrameComparer(
    const PinholeCamera& left, std::shared_ptr<const SharedRasters> shared = nullptr,
    std::shared_ptr<SharedModel> model = nullptr);

}  // namespace softscope::cuda
