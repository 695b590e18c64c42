// cuda/warp/model_warp.h: warp of the model on the first GPU.
#pragma once

#include <memory>

#include "cuda/model/shared_model.h"
#include "deform/graph/model_warp.h"

namespace softscope::cuda {

/// Of the model on the device. Throws BackendError where no GPU works.
std::unique_ptr<ModelWarp> makeModelWarp(std::shared_ptr<SharedModel> model);

}  // namespace softscope::cuda
