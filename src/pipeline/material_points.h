// src/pipeline/material_points.h: material points tracked through the whole run.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/point_model.h"
#include "core/raster.h"
#include "core/warp_graph.h"
#include "fusion/density_grid.h"
#include "pipeline/first_look.h"

namespace softscope {

/// A pixel of the first left image, as it is on disk.
struct TrackSeed {
  int id = 0;
  double u_px = 0, v_px = 0;
};

/// Where a piece of tissue is. position_mm: world frame; NaN where it was never found. sigma_mm:
/// predicted root mean square error of the position in the scope's frame; NaN where unknown.
struct TrackedPosition {
  int id = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool visible = false;
  double sigma_mm = std::numeric_limits<double>::quiet_NaN();
};

/// Follows points by the warp that carries the model point beside them; after fusion they are
/// placed where the image shows what they looked like at first, and laid back onto the model's
/// surface, so that points and surface stay one thing.
class MaterialPoints {
 public:
  struct Point {
    int id = 0;
    std::int32_t model_point = -1;  // the one beside it; -1 where the tissue was never measured
    Eigen::Vector3d position_mm =
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    /// Where its neighbours of the first image, one pixel right and one down, lie from it; the warp
    /// carries them.
    Eigen::Matrix<double, 3, 2> pixels_mm = Eigen::Matrix<double, 3, 2>::Zero();
    FirstLook look;
    /// Predicted, of the place along the surface, in each of two directions; NaN where unknown.
    double variance_mm2 = 0;
  };

  /// A seed in the rectified left camera: lies where its ray meets the depth around the pixel.
  void add(int id, const Eigen::Vector2d& pixel, const PinholeCamera& left,
           const Raster<float>& depth_mm, const Eigen::Isometry3d& world_from_left);
  /// Ties points that have none to the nearest model point.
  void anchor(const PointModel& model);
  /// Moves them by the graph's warp, before it is re-based.
  void warp(const WarpGraph& graph, const PointModel& model);
  /// Model points have new numbers.
  void renumber(const IndexMap& map, const PointModel& model);
  /// Takes how they look in the image, now that they lie on the tissue; their surface is the
  /// model's around them.
  void look(const GrayImage& image, const Mask& ignore, const PointModel& model,
            const PinholeCamera& left, const Eigen::Isometry3d& world_from_left);
  /// Moves them along the surface towards where the image shows their first looks, or with their
  /// neighbours, and predicts how far off they are: docs/fusion.md (F29). `node_spacing_mm`: of the
  /// graph that warped them. `inSight`: whether the image shows a point of the left camera's frame.
  void align(const GrayImage& image, const Mask& ignore, const PinholeCamera& left,
             const Eigen::Isometry3d& world_from_left, double node_spacing_mm,
             const std::function<bool(const Eigen::Vector3d&)>& inSight);
  /// Lays them onto the surface that the model's points around them make, along the rays of the
  /// scope at `scope_mm`, as fusion moves the model's points: docs/fusion.md (F8). `limit_scale`:
  /// DepthSummary::limit_scale of the frame.
  void settle(const PointModel& model, const Eigen::Vector3d& scope_mm, double limit_scale);

  std::vector<Point> points;
  /// How far a frame's warp leads astray, per direction: what first looks said last; NaN before.
  double drift_mm2 = std::numeric_limits<double>::quiet_NaN();
};
static_assert(sizeof(MaterialPoints::Point) == 8 + 10 * sizeof(double) + sizeof(FirstLook),
              "no padding between or behind the members");

}  // namespace softscope
