// toolkit/evaluation/evaluate_maps.h: error maps of selected models, for interactive views.
#pragma once

#include <cstddef>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/surfaces/model_errors.h"
#include "mesh/coarse_mesh.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

/// Indices of the points kept in the map of a model with `count` points, in the order of the map.
std::vector<std::size_t> indicesOfMap(std::size_t count);

/// Keeps at most 24 of `moments` models, evenly spread and including the last,
/// each with at most 20 000 evenly spread points, and the decimated true surface.
class ErrorMaps {
 public:
  explicit ErrorMaps(std::size_t moments) : moments_(moments) {}

  /// True if the next added model is kept.
  bool keepsNext() const;
  /// `points_mm` and `truth` in the same frame; `world_from_left`:
  /// camera pose in it. Called for every model.
  void add(int frame, double time_s, const std::vector<Eigen::Vector3f>& points_mm,
           const ModelErrors& errors, const TriangleMesh& truth,
           const Eigen::Isometry3d& world_from_left);

  const std::vector<ErrorMap>& kept() const { return kept_; }

 private:
  TriangleMesh coarse(const TriangleMesh& truth);

  std::size_t moments_, next_ = 0;
  std::vector<ErrorMap> kept_;
  CoarseMesh coarse_;  // of the first truth; valid while the triangles are unchanged
  TriangleMesh first_truth_;
};

}  // namespace softscope
