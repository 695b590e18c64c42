// src/pipeline/model/united_models.h: one model of two that overlap.
#pragma once

#include <Eigen/Geometry>

#include "pipeline/model/model_state.h"

namespace softscope {

/// Adds the points of `other` that are farther than 1 to 2 mm from every point of `into`, in its
/// exposure, unbound until the graph grows. Both models have the shape of the same frame.
void uniteModels(const ModelState& other, const Eigen::Isometry3d& into_from_other,
                 ModelState* into);

}  // namespace softscope
