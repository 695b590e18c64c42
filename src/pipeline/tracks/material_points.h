// src/pipeline/tracks/material_points.h: material points tracked through the run.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/camera.h"
#include "core/depth_map.h"
#include "core/image.h"
#include "core/point_model.h"
#include "core/raster.h"
#include "core/warp_graph.h"
#include "features/first_look.h"
#include "fusion/density_grid.h"
#include "fusion/surface_search.h"

namespace softscope {

/// A pixel of the first left image as stored.
struct TrackSeed {
  int id = 0;
  double u_px = 0, v_px = 0;
};

/// Position of a material point. position_mm: world frame; NaN before it was measured, until when
/// its depth is that of other pixels. sigma_mm: predicted root mean square error of the position in
/// the frame of the scope; NaN if unknown.
struct TrackedPosition {
  int id = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool visible = false;
  double sigma_mm = std::numeric_limits<double>::quiet_NaN();
  bool measured = false;  // visible, with a depth of its own
};

/// Share of the visible points whose predicted error is tolerable with a probability of 95 %. NaN
/// without visible points.
double preciseShare(const std::vector<TrackedPosition>& positions);

/// Finds first looks in an image.
using LookSearcher = std::function<std::vector<FoundLook>(const std::vector<SoughtLook>&)>;

/// Moves points by the warp of the nearest model point; after fusion they
/// are placed where the image shows their first looks, and projected onto
/// the surface of the model, so that points and surface stay consistent.
class MaterialPoints {
 public:
  struct Point {
    int id = 0;
    std::int32_t model_point = -1;  // the nearest one; -1 if the tissue was never measured
    Eigen::Vector3d position_mm =
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    /// Offsets of its neighbours in the first image,
    /// one pixel right and one down; moved by the warp.
    Eigen::Matrix<double, 3, 2> pixels_mm = Eigen::Matrix<double, 3, 2>::Zero();
    FirstLook look;
    std::int64_t measured_frames = 0;  // so far
    /// Predicted, of the position along the surface, per direction; NaN if unknown.
    double variance_mm2 = 0;
  };

  /// A seed in the rectified left camera: where its ray intersects the depth around the pixel.
  void add(int id, const Eigen::Vector2d& pixel, const PinholeCamera& left,
           const Raster<float>& depth_mm, const Eigen::Isometry3d& world_from_left);
  /// Binds unbound points to the nearest model point.
  void anchor(const PointModel& model, SurfaceSearch* search);
  /// Moves them by the warp of the graph, before it is re-based. `node_spacing_mm`: of its nodes.
  void warp(const WarpGraph& graph, const PointModel& model, double node_spacing_mm);
  /// Updates the numbers of model points; a point whose model point was removed, or is more than a
  /// spacing away, is bound to the nearest one.
  void renumber(const IndexMap& map, const PointModel& model, double node_spacing_mm,
                SurfaceSearch* search);
  /// Takes their first looks from the image, once they are on
  /// the tissue; their surface is that of the model around them, and
  /// what lies off it in the depth of the image is not part of their looks.
  void look(const LookPicture& picture, const PointModel& model, const PinholeCamera& left,
            const Eigen::Isometry3d& world_from_left, const DepthMap& depth);
  /// Moves them along the surface to where the image shows their first looks, or with their
  /// neighbours, and predicts their error: docs/fusion.md (F29). `findLooks`: in that image; a look
  /// has the number of its point. `node_spacing_mm`: of the graph that warped them. `inSight`:
  /// whether the image shows a point of the left camera frame.
  void align(const LookSearcher& findLooks, const PinholeCamera& left,
             const Eigen::Isometry3d& world_from_left, double node_spacing_mm,
             const std::function<bool(const Eigen::Vector3d&)>& inSight);
  /// Moves them towards the surface of the model points around them, along the
  /// rays of the scope at `scope_mm`, like fusion moves the points of the model:
  /// docs/fusion.md (F8). `limit_scale`: DepthSummary::limit_scale of the frame.
  void settle(const PointModel& model, const Eigen::Vector3d& scope_mm, double limit_scale,
              SurfaceSearch* search);

  /// Of a frame that was fused, one position per point.
  void countMeasured(const std::vector<TrackedPosition>& positions);
  /// A single measurement may be of another surface: from the second frame on, what fewer than two
  /// frames measured has no position.
  void hideUnmeasured(std::vector<TrackedPosition>* positions) const;

  std::vector<Point> points;
  std::int64_t fused_frames = 0;
  /// Drift variance of a warp, per direction, from the last first looks; NaN before.
  double drift_mm2 = std::numeric_limits<double>::quiet_NaN();
};
static_assert(sizeof(MaterialPoints::Point) == 8 + 11 * sizeof(double) + sizeof(FirstLook),
              "no padding between or behind the members");

}  // namespace softscope
