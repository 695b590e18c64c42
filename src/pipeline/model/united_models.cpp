#include "pipeline/model/united_models.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fusion/cell_table.h"
#include "fusion/colour_levels.h"

namespace softscope {
namespace {

constexpr float kCellMm = 1;

CellKey keyOf(const Eigen::Vector3f& point_mm) {
  return cellKey(point_mm, Eigen::Vector3f::Constant(kCellMm));
}

/// The cells of space that hold points.
class OccupiedCells {
 public:
  explicit OccupiedCells(const std::vector<Eigen::Vector3f>& points_mm) : table_(points_mm.size()) {
    for (const Eigen::Vector3f& point_mm : points_mm) insert(keyOf(point_mm));
  }
  /// True if the cell of the point, or one next to it, holds points.
  bool around(const Eigen::Vector3f& point_mm) const {
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          if (hold(keyOf(point_mm + kCellMm * Eigen::Vector3i(x, y, z).cast<float>()))) return true;
    return false;
  }

 private:
  std::int32_t& slotOf(CellKey key) const {
    return table_.find(key, [&](std::int32_t entry) { return keys_[entry] == key; });
  }
  bool hold(CellKey key) const { return key != kNoCell && slotOf(key) != CellHashTable::kEmpty; }
  void insert(CellKey key) {
    if (key == kNoCell || hold(key)) return;
    slotOf(key) = static_cast<std::int32_t>(keys_.size());
    keys_.push_back(key);
  }

  std::vector<CellKey> keys_;
  mutable CellHashTable table_;
};

}  // namespace

void uniteModels(const ModelState& other, const Eigen::Isometry3d& into_from_other,
                 ModelState* into) {
  const Eigen::Isometry3f move = into_from_other.cast<float>();
  const ColourGain &from = other.exposure, &to = into->exposure;
  const OccupiedCells known(into->model.positions_mm);
  const PointModel& more = other.model;
  for (std::size_t i = 0; i < more.size(); ++i) {
    const Eigen::Vector3f position_mm = move * more.positions_mm[i];
    if (known.around(position_mm)) continue;
    into->model.add(
        position_mm, move.linear() * more.normals[i],
        scaled(more.colours[i], from.red / to.red, from.green / to.green, from.blue / to.blue),
        more.weights[i]);
  }
}

}  // namespace softscope
