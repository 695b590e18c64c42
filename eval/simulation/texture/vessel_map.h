// eval/simulation/texture/vessel_map.h: vessel at a surface point.
#pragma once

#include <vector>

#include "eval/simulation/texture/vessel_growth.h"

namespace softscope {

/// Vessel with the largest coverage at a position.
struct VesselCover {
  float artery = 0;  // 0 (outside) to 1 (on its axis)
  float vein = 0;
  float raised_mm = 0;  // elevation of the surface by the vessel
};

/// Search of segments by a grid over their box.
class VesselMap {
 public:
  explicit VesselMap(std::vector<VesselSegment> segments);

  VesselCover coverAt(const Eigen::Vector3f& place_mm) const;

 private:
  Eigen::Array3i cellOf(const Eigen::Vector3f& place_mm) const;
  std::size_t indexOf(const Eigen::Array3i& cell) const;
  void countAndFill();

  std::vector<VesselSegment> segments_;
  Eigen::Vector3f low_mm_ = Eigen::Vector3f::Zero();
  float cell_mm_ = 1;
  Eigen::Array3i cells_ = Eigen::Array3i::Zero();
  std::vector<std::int32_t> begins_;  // first entry of each cell, and the total count
  std::vector<std::int32_t> entries_;
};

}  // namespace softscope
