// eval/surfaces/surface_alignment.h: slides a rigid cloud of points onto a surface.
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
  double trimmed_share = 0.1;       // of the pairs, the farthest: left out of every step
  bool leave_out_border = true;     // pairs whose closest point lies on the surface's border
  double converged_step_mm = 1e-4;  // root mean square motion of the points by the last step

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

enum class AlignmentStop { kConverged, kIterationLimit, kTooFewPairs };

/// What the alignment found, and how far the points lay before and after. Errors before hide
/// nothing; errors after hide whatever a rigid motion can explain: report both.
struct SurfaceAlignment {
  Eigen::Isometry3d surface_from_points = Eigen::Isometry3d::Identity();
  AlignmentStop stop = AlignmentStop::kIterationLimit;
  int iterations = 0;
  std::size_t pair_count = 0;  // that shaped the last step
  int free_directions = 0;     // of six, that the surface leaves undetermined; not moved along
  SurfaceErrors before;        // of all points, at the start given
  SurfaceErrors after;         // of all points, by surface_from_points

  bool converged() const { return stop == AlignmentStop::kConverged; }
};

/// Iterative closest points (Besl and McKay 1992; to planes: Chen and Medioni 1991), trimmed
/// (Chetverikov et al. 2002). Points, mm, that are not finite take no part.
SurfaceAlignment alignToSurface(
    const std::vector<Eigen::Vector3f>& points_mm, const TriangleTree& surface,
    const AlignmentOptions& options = {},
    const Eigen::Isometry3d& surface_from_points_start = Eigen::Isometry3d::Identity());

/// Every point moved; double inside, float out.
std::vector<Eigen::Vector3f> movePoints(const Eigen::Isometry3d& to_from_points,
                                        const std::vector<Eigen::Vector3f>& points_mm);

}  // namespace softscope
