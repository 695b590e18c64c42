// eval/simulation/texture/vessel_map.cpp: grid of segments.
#include "eval/simulation/texture/vessel_map.h"

#include <algorithm>
#include <cmath>

#include "eval/simulation/noise/noise.h"

namespace softscope {
namespace {

constexpr float kSmallestCell_mm = 0.7F;
constexpr float kMostCellsPerSide = 160;
constexpr float kSoftEdge_mm = 0.05F;  // vessels are seen through a thin layer of tissue

float reach_mm(const VesselSegment& s) {
  return std::max(s.begin_radius_mm, s.end_radius_mm) + kSoftEdge_mm;
}

void addCover(VesselCover& cover, const VesselSegment& s, const Eigen::Vector3f& place_mm) {
  const Eigen::Vector3f along = s.end_mm - s.begin_mm;
  const float length2 = along.squaredNorm();
  float t = length2 > 0 ? (place_mm - s.begin_mm).dot(along) / length2 : 0;
  t = std::clamp(t, 0.0F, 1.0F);
  const float distance_mm = (place_mm - s.begin_mm - t * along).norm();
  const float radius_mm = s.begin_radius_mm + t * (s.end_radius_mm - s.begin_radius_mm);
  if (distance_mm >= radius_mm + kSoftEdge_mm) return;
  const float edge_mm = std::max(0.0F, radius_mm - 2 * kSoftEdge_mm);
  const float strength = 1 - smoothStep(edge_mm, radius_mm + kSoftEdge_mm, distance_mm);
  float& kind = s.is_vein ? cover.vein : cover.artery;
  kind = std::max(kind, strength * std::min(1.0F, 0.35F + 2.2F * radius_mm));
  const float across = std::min(1.0F, distance_mm / (radius_mm + kSoftEdge_mm));
  cover.raised_mm = std::max(cover.raised_mm, 0.35F * radius_mm * (1 - across * across));
}

}  // namespace

VesselMap::VesselMap(std::vector<VesselSegment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  Eigen::Array3f low = segments_[0].begin_mm.array(), high = low;
  for (const VesselSegment& s : segments_) {
    low = low.min(s.begin_mm.array() - reach_mm(s)).min(s.end_mm.array() - reach_mm(s));
    high = high.max(s.begin_mm.array() + reach_mm(s)).max(s.end_mm.array() + reach_mm(s));
  }
  low_mm_ = low.matrix();
  cell_mm_ = std::max(kSmallestCell_mm, (high - low).maxCoeff() / kMostCellsPerSide);
  cells_ = ((high - low) / cell_mm_).floor().cast<int>() + 1;
  countAndFill();
}

Eigen::Array3i VesselMap::cellOf(const Eigen::Vector3f& place_mm) const {
  return ((place_mm - low_mm_).array() / cell_mm_).floor().cast<int>();
}

std::size_t VesselMap::indexOf(const Eigen::Array3i& cell) const {
  return (std::size_t(cell.z()) * cells_.y() + cell.y()) * cells_.x() + cell.x();
}

void VesselMap::countAndFill() {
  const auto forEachCell = [&](const VesselSegment& s, const auto& visit) {
    const float reach = reach_mm(s);
    const Eigen::Array3f low = s.begin_mm.array().min(s.end_mm.array()) - reach;
    const Eigen::Array3f high = s.begin_mm.array().max(s.end_mm.array()) + reach;
    const Eigen::Array3i first = cellOf(low.matrix()).max(0);
    const Eigen::Array3i last = cellOf(high.matrix()).min(cells_ - 1);
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (int x = first.x(); x <= last.x(); ++x) visit(indexOf({x, y, z}));
  };
  begins_.assign(std::size_t(cells_.x()) * cells_.y() * cells_.z() + 1, 0);
  for (const VesselSegment& s : segments_)
    forEachCell(s, [&](std::size_t cell) { ++begins_[cell + 1]; });
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  entries_.resize(begins_.back());
  std::vector<std::int32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i)
    forEachCell(segments_[i],
                [&](std::size_t cell) { entries_[next[cell]++] = static_cast<std::int32_t>(i); });
}

VesselCover VesselMap::coverAt(const Eigen::Vector3f& place_mm) const {
  VesselCover cover;
  if (segments_.empty()) return cover;
  const Eigen::Array3i cell = cellOf(place_mm);
  if ((cell < 0).any() || (cell >= cells_).any()) return cover;
  const std::size_t index = indexOf(cell);
  for (std::int32_t i = begins_[index]; i < begins_[index + 1]; ++i)
    addCover(cover, segments_[entries_[i]], place_mm);
  return cover;
}

}  // namespace softscope
