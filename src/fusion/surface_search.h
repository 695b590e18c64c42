// src/fusion/surface_search.h: the model's surface around a few positions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/point_model.h"

namespace softscope {

/// Sums over the model points around a position; their weights decrease to 0 at kSurfacePieceMm.
/// The height is that of the points over the position, along their normals.
struct SurfacePiece {
  double weight = 0, height_mm = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Same results on every back end.
class SurfaceSearch {
 public:
  virtual ~SurfaceSearch() = default;
  /// Number of the model point nearest to each position, the first of equally near ones; -1 without
  /// any.
  virtual std::vector<std::int32_t> nearestPoints(
      const PointModel& model, const std::vector<Eigen::Vector3f>& positions_mm) = 0;
  virtual std::vector<SurfacePiece> piecesAround(
      const PointModel& model, const std::vector<Eigen::Vector3d>& positions_mm) = 0;
};

/// On the CPU.
class CpuSurfaceSearch final : public SurfaceSearch {
 public:
  std::vector<std::int32_t> nearestPoints(
      const PointModel& model, const std::vector<Eigen::Vector3f>& positions_mm) override;
  std::vector<SurfacePiece> piecesAround(const PointModel& model,
                                         const std::vector<Eigen::Vector3d>& positions_mm) override;
};

}  // namespace softscope
