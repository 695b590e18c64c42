// cuda/fusion/fusion.h: stage 7 on the first GPU.
#pragma once

#include <memory>

#include "core/camera.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/model/shared_model.h"
#include "fusion/model_updater.h"

namespace softscope::cuda {

/// `shared`: tells what rasters lie on the device already; `model`: the model there. Both may be
/// null. Throws BackendError where no GPU works.
std::unique_ptr<ModelUpdater> makeModelUpdater(
    const PinholeCamera& left, std::shared_ptr<const SharedRasters> shared = nullptr,
    std::shared_ptr<SharedModel> model = nullptr);

}  // namespace softscope::cuda
