// src/deform/graph/model_warp.h: warp of a model's points as an interface.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"

namespace softscope {

/// Carries points and normals by docs/energy.md (2), (24), on any device. All implementations give
/// the same bytes.
class ModelWarp {
 public:
  virtual ~ModelWarp() = default;
  /// By the graph's transforms. True where the host's points have moved; otherwise they stay as
  /// they were until the device's model replaces them.
  virtual bool apply(const WarpGraph& graph, PointModel* model) = 0;
  /// The points are again where they were before apply().
  virtual void undo(PointModel* model) = 0;
};

class CpuModelWarp final : public ModelWarp {
 public:
  bool apply(const WarpGraph& graph, PointModel* model) override;
  void undo(PointModel* model) override;

 private:
  std::vector<Eigen::Vector3f> positions_mm_, normals_;  // before; or memory to reuse
};

}  // namespace softscope
