#include "fusion/surface_search.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/parallel.h"
#include "fusion/cell_table.h"
#include "fusion/surface_formulas.h"

namespace softscope {
namespace {

/// Without std::floor(), which is a call into the C library where SSE4.1 is not taken for granted.
std::int64_t floorOf(double x) {
  const std::int64_t whole = static_cast<std::int64_t>(x);
  return whole - (static_cast<double>(whole) > x ? 1 : 0);
}

constexpr std::int64_t kBias = 1 << 20;  // cells on either side of the origin, per axis

/// False where the position is not finite or farther than the cells reach.
bool hasCell(const Eigen::Vector3d& position_mm) {
  return (position_mm.array().abs() < (kBias - 1) * kSurfacePieceMm).all();
}

std::int64_t cellOf(const Eigen::Vector3d& position_mm) {
  return (floorOf(position_mm.x() / kSurfacePieceMm) + kBias) << 42 |
         (floorOf(position_mm.y() / kSurfacePieceMm) + kBias) << 21 |
         (floorOf(position_mm.z() / kSurfacePieceMm) + kBias);
}

/// Positions in and next to each cell.
class PositionsNear {
 public:
  explicit PositionsNear(std::size_t expected) : table_(expected) {
    keys_.reserve(expected);
    positions_.reserve(expected);
    next_.reserve(expected);
  }
  void add(std::int64_t cell, int position) {
    const std::int32_t entry = static_cast<std::int32_t>(keys_.size());
    keys_.push_back(static_cast<CellKey>(cell));
    positions_.push_back(position);
    std::int32_t& first = firstOf(keys_.back());
    next_.push_back(first);
    first = entry;
  }
  bool empty() const { return keys_.empty(); }
  /// Calls found(position) for each position in or next to the cell.
  template <class Found>
  void forEach(std::int64_t cell, const Found& found) const {
    for (std::int32_t entry = firstOf(static_cast<CellKey>(cell)); entry != CellHashTable::kEmpty;
         entry = next_[static_cast<std::size_t>(entry)])
      found(positions_[static_cast<std::size_t>(entry)]);
  }

 private:
  /// The last entry of the cell; the others follow from it.
  std::int32_t& firstOf(CellKey key) const {
    return table_.find(key, [&](std::int32_t entry) { return keys_[entry] == key; });
  }

  mutable CellHashTable table_;
  std::vector<CellKey> keys_;  // per entry, like the others
  std::vector<int> positions_;
  std::vector<std::int32_t> next_;
};

struct PositionShare {
  int position;
  SurfaceShare share;
};

/// Of all model points, in their order.
std::vector<PositionShare> sharesOf(const PositionsNear& near, const PointModel& model,
                                    const std::vector<Eigen::Vector3d>& positions_mm) {
  std::vector<PositionShare> all;
  if (near.empty()) return all;
  const std::size_t grain = kPointsPerTask, tasks = (model.size() + grain - 1) / grain;
  std::vector<std::vector<PositionShare>> parts(tasks);
  parallelRanges(static_cast<int>(tasks), 1, [&](int begin, int end) {
    for (std::size_t task = static_cast<std::size_t>(begin); task < static_cast<std::size_t>(end);
         ++task)
      for (std::size_t i = task * grain; i < std::min(model.size(), (task + 1) * grain); ++i) {
        const Eigen::Vector3d point_mm = model.positions_mm[i].cast<double>();
        if (!hasCell(point_mm)) continue;
        near.forEach(cellOf(point_mm), [&](int k) {
          SurfaceShare share;
          if (surfaceShare(model.positions_mm[i], model.normals[i], model.weights[i],
                           positions_mm[static_cast<std::size_t>(k)], &share))
            parts[task].push_back({k, share});
        });
      }
  });
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::int32_t nearestPoint(const PointModel& model, const Eigen::Vector3f& position_mm) {
  std::int32_t nearest = -1;
  float best = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const float distance = squaredDistance(model.positions_mm[i], position_mm);
    if (distance < best) {
      best = distance;
      nearest = static_cast<std::int32_t>(i);
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::int32_t> CpuSurfaceSearch::nearestPoints(
    const PointModel& model, const std::vector<Eigen::Vector3f>& positions_mm) {
  constexpr int kSearchesPerTask = 1;  // each visits the whole model
  std::vector<std::int32_t> nearest(positions_mm.size());
  parallelRanges(static_cast<int>(nearest.size()), kSearchesPerTask, [&](int begin, int end) {
    for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      nearest[k] = nearestPoint(model, positions_mm[k]);
  });
  return nearest;
}

std::vector<SurfacePiece> CpuSurfaceSearch::piecesAround(
    const PointModel& model, const std::vector<Eigen::Vector3d>& positions_mm) {
  constexpr int kCellsAround = 27;
  PositionsNear near(positions_mm.size() * kCellsAround);
  for (std::size_t k = 0; k < positions_mm.size(); ++k)
    for (int cell = 0; cell < kCellsAround; ++cell) {
      const Eigen::Vector3d step(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
      const Eigen::Vector3d neighbour_mm = positions_mm[k] + kSurfacePieceMm * step;
      if (hasCell(neighbour_mm)) near.add(cellOf(neighbour_mm), static_cast<int>(k));
    }
  std::vector<SurfacePiece> pieces(positions_mm.size());
  for (const PositionShare& each : sharesOf(near, model, positions_mm)) {
    SurfacePiece& piece = pieces[static_cast<std::size_t>(each.position)];
    piece.weight += each.share.weight;
    piece.height_mm += each.share.height_mm;
    for (int c = 0; c < 3; ++c) piece.normal[c] += each.share.normal[c];
  }
  return pieces;
}

}  // namespace softscope
