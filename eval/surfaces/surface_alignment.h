// eval/surfaces/surface_alignment.h: rigid alignment of points to a surface (ICP).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "eval/surfaces/surface_errors.h"

namespace softscope {

enum class AlignmentMetric { kPointToPlane, kPointToPoint };

struct AlignmentOptions {
  AlignmentMetric metric = AlignmentMetric::kPointToPlane;
  int max_iterations = 50;
  double trimmed_share = 0.1;       // share of the farthest pairs, left out of each step
  bool leave_out_border = true;     // pairs with a closest point on the border of the surface
  double converged_step_mm = 1e-4;  // root mean square motion of the points in the last step

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

enum class AlignmentStop { kConverged, kIterationLimit, kTooFewPairs };

/// Result of the alignment, with errors before and after it. Errors before
/// include the rigid transform; errors after do not, so both must be reported.
struct SurfaceAlignment {
  Eigen::Isometry3d surface_from_points = Eigen::Isometry3d::Identity();
  AlignmentStop stop = AlignmentStop::kIterationLimit;
  int iterations = 0;
  std::size_t pair_count = 0;  // in the last step
  int free_directions = 0;     // undetermined directions of six; without motion
  SurfaceErrors before;        // all points, at the initial pose
  SurfaceErrors after;         // all points, at surface_from_points

  bool converged() const { return stop == AlignmentStop::kConverged; }
};

/// Iterative closest points (Besl and McKay 1992; point-to-plane: Chen and Medioni 1991),
/// trimmed (Chetverikov et al. 2002). Points, mm, that are not finite are excluded.
SurfaceAlignment alignToSurface(
    const std::vector<Eigen::Vector3f>& points_mm, const TriangleTree& surface,
    const AlignmentOptions& options = {},
    const Eigen::Isometry3d& surface_from_points_start = Eigen::Isometry3d::Identity());

/// Transforms every point; computed in double, returned in float.
std::vector<Eigen::Vector3f> movePoints(const Eigen::Isometry3d& to_from_points,
                                        const std::vector<Eigen::Vector3f>& points_mm);

}  // namespace softscope
