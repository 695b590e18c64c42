// cuda/surface/surface.h: the model's surface around a few positions, on the first GPU.
#pragma once

#include <memory>

#include "cuda/model/shared_model.h"
#include "fusion/surface_search.h"

namespace softscope::cuda {

/// `model`: the model on the device; may be null. Throws BackendError where no GPU works.
std::unique_ptr<SurfaceSearch> makeSurfaceSearch(std::shared_ptr<SharedModel> model = nullptr);

}  // namespace softscope::cuda
