// src/features/descriptor_matching.h: nearest descriptors within a search radius, with cross-check.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "features/dense_surf.h"
#include "features/matcher_options.h"
#include "features/shift_field.h"

namespace softscope {

/// A pair of matched grid nodes.
struct NodeMatch {
  Eigen::Vector2f model_px;
  Eigen::Vector2f live_px;
  Eigen::Vector2f parabola_px;  // live_px moved to the lowest point of parabolas in u and in v
  float ratio = 1;              // best distance over the best one elsewhere; below 1 = distinct
};

/// Nodes that pass the ratio test and the mutual test, searched within `radius_px` of the predicted
/// shift; the most distinct one per square of spacing_px. In the order of the rows of model nodes.
std::vector<NodeMatch> matchDescriptors(const DenseDescriptors& model, const DenseDescriptors& live,
                                        const ShiftField& predicted, double radius_px,
                                        const MatcherOptions& options);

}  // namespace softscope
