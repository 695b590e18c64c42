// eval/surfaces/model_errors.h: errors of a model against the true tissue of its frame.
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

/// Ground truth of one frame. Non-owning.
struct TrueMoment {
  const TriangleTree& surface;    // in the frame of the true world
  const Raster<float>& depth_mm;  // of the rectified left image, NaN = none; empty = unknown
  const RectifiedRig& rig;        // used with a known depth
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

/// Share of the visible tissue covered by the model.
struct Completeness {
  Statistics distance_mm;            // of the sampled tissue to the nearest model point
  double share = Statistics::kNone;  // share with a model point within the threshold
};

/// Definitions: docs/evaluation.md. Values that require the depth are NaN, or empty, without it.
struct ModelErrors {
  Statistics distance_mm;        // of every model point to the surface
  Statistics signed_mm;          // the same, positive = outside; NaN at the border of the surface
  std::size_t border_count = 0;  // points with a closest point on that border
  std::size_t beyond_count = 0;  // points beyond the border, where the truth is unknown
  Statistics observed_mm;        // points whose tissue is visible to the left camera
  Statistics observed_signed_mm;
  Statistics predicted_mm;  // other points not beyond the border: invisible, moved by the warp
  double observed_share = Statistics::kNone;  // of the points
  Completeness both;                          // tissue visible to both cameras
  Completeness left;                          // tissue visible to the left camera
  HausdorffDistances hausdorff;               // observed points, and tissue visible to both cameras

  /// One per model point, in their order.
  std::vector<double> each_mm, each_signed_mm;
  std::vector<std::uint8_t> each_observed;  // empty without a known depth; 0 beyond the border
  std::vector<std::uint8_t> each_beyond;
};

/// `points_mm`: model, in the frame of the true world. Tissue counts as reconstructed
/// if a model point is within `completeness_mm`. Throws InputError without points.
ModelErrors modelErrors(const std::vector<Eigen::Vector3f>& points_mm, const TrueMoment& truth,
                        double completeness_mm = 1.0);

}  // namespace softscope
