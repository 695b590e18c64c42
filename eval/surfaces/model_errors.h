// eval/surfaces/model_errors.h: one reconstructed model against the true tissue of the same moment.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "core/stereo_rig.h"
#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"
#include "eval/surfaces/visible_tissue.h"

namespace softscope {

/// What is true at one moment. Nothing is owned.
struct TrueMoment {
  const TriangleTree& surface;    // in the true world's frame
  const Raster<float>& depth_mm;  // of the rectified left image, NaN = none; empty = unknown
  const RectifiedRig& rig;        // needed where the depth is known
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

/// How much of the tissue that the cameras see the model has.
struct Completeness {
  Statistics distance_mm;            // of the sampled tissue from the nearest model point
  double share = Statistics::kNone;  // of it with a model point nearer than the threshold
};

/// Definitions: docs/evaluation.md. What the depth decides is NaN, or empty, where it is unknown.
struct ModelErrors {
  Statistics distance_mm;        // of every model point from the surface
  Statistics signed_mm;          // the same, positive = outside; NaN at the surface's border
  std::size_t border_count = 0;  // points whose closest point lies on that border
  std::size_t beyond_count = 0;  // points beyond it, where no tissue is known
  Statistics observed_mm;        // of the points whose tissue the left camera sees now
  Statistics observed_signed_mm;
  Statistics predicted_mm;  // of the others that aren't beyond: unseen, carried by the warp
  double observed_share = Statistics::kNone;  // of the points
  Completeness both;                          // tissue that both cameras see
  Completeness left;                          // tissue that the left camera sees
  HausdorffDistances hausdorff;               // observed points and tissue that both cameras see

  /// One a model point, in its order.
  std::vector<double> each_mm, each_signed_mm;
  std::vector<std::uint8_t> each_observed;  // empty where the depth is unknown; 0 beyond the border
  std::vector<std::uint8_t> each_beyond;
};

/// `points_mm`: the model, in the true world's frame. A piece of tissue counts as reconstructed
/// where a model point lies nearer than `completeness_mm`. Throws InputError if there is no point.
ModelErrors modelErrors(const std::vector<Eigen::Vector3f>& points_mm, const TrueMoment& truth,
                        double completeness_mm = 1.0);

}  // namespace softscope
