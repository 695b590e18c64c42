#include "deform/graph/surface_region.h"

#include <cmath>

namespace softscope {
namespace {

/// With all cubes at most `by` away along each axis.
CellNumbering widened(CellNumbering cubes, int by, double cell_mm) {
  for (int Cube::*axis : {&Cube::x, &Cube::y, &Cube::z}) {
    CellNumbering wider(cell_mm);
    for (int number = 0; number < cubes.size(); ++number) {
      Cube cube = cubes.cube(number);
      cube.*axis -= by;
      for (int step = -by; step <= by; ++step, ++(cube.*axis)) wider.findOrAdd(cube);
    }
    cubes = std::move(wider);
  }
  return cubes;
}

}  // namespace

SurfaceRegion::SurfaceRegion(const std::vector<Eigen::Vector3f>& positions_mm,
                             const std::vector<int>& points, double reach_mm, double cell_mm)
    : cells_(cell_mm), blocks_(cell_mm), is_everywhere_(false) {
  const double block_mm = CellNumbering::kBlockSide * cell_mm;
  const int around = static_cast<int>(std::ceil(reach_mm / block_mm));
  Cube cube;
  for (const int point : points) {
    if (!cells_.cubeOf(positions_mm[point], &cube)) continue;
    blocks_.findOrAdd(blockOf(cube));
    box_mm_.extend(positions_mm[point]);
  }
  blocks_ = widened(std::move(blocks_), around, cell_mm);
  const Eigen::Vector3f margin_mm =
      Eigen::Vector3f::Constant(static_cast<float>((around + 2) * block_mm));
  box_mm_ = {box_mm_.min() - margin_mm, box_mm_.max() + margin_mm};
}

}  // namespace softscope
