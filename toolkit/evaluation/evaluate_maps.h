// toolkit/evaluation/evaluate_maps.h: error maps of some evaluated models, for interactive views.
#pragma once

#include <cstddef>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/surfaces/model_errors.h"
#include "mesh/coarse_mesh.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

/// Which points of a model with `count` points its map keeps, in the map's order.
std::vector<std::size_t> indicesOfMap(std::size_t count);

/// Keeps at most 24 of `moments` models, evenly spread and the last among them, of each at most
/// 20 000 points, evenly spread over its order, and beside them the true surface, coarse.
class ErrorMaps {
 public:
  explicit ErrorMaps(std::size_t moments) : moments_(moments) {}

  /// Whether the next model that is added will be kept.
  bool keepsNext() const;
  /// `points_mm` and `truth` in one frame; `world_from_left`: the camera's pose there. For every
  /// model in turn, kept or not.
  void add(int frame, double time_s, const std::vector<Eigen::Vector3f>& points_mm,
           const ModelErrors& errors, const TriangleMesh& truth,
           const Eigen::Isometry3d& world_from_left);

  const std::vector<ErrorMap>& kept() const { return kept_; }

 private:
  TriangleMesh coarse(const TriangleMesh& truth);

  std::size_t moments_, next_ = 0;
  std::vector<ErrorMap> kept_;
  CoarseMesh coarse_;  // of the first truth; holds as long as its triangles are the same
  TriangleMesh first_truth_;
};

}  // namespace softscope
