#include "deform/graph/surface_cells.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kCellsPerTask = 512;
constexpr int kBlocksPerTask = 8;

/// A part of the points, with cells of its own.
struct PartOfPoints {
  explicit PartOfPoints(double cell_mm) : table(cell_mm) {}

  /// Those of [begin, end) inside of the region.
  void take(const std::vector<Eigen::Vector3f>& positions_mm, int begin, int end,
            const SurfaceRegion& region) {
    points.reserve(static_cast<std::size_t>(end - begin));
    cell_of.reserve(points.capacity());
    Cube cube, last_block{-1, -1, -1};
    bool is_inside = false;
    for (int point = begin; point < end; ++point) {
      if (!region.mayContain(positions_mm[point]) || !table.cubeOf(positions_mm[point], &cube))
        continue;
      const Cube block = SurfaceRegion::blockOf(cube);
      if (!(block == last_block)) is_inside = region.contains(block);
      last_block = block;
      if (!is_inside) continue;
      points.push_back(point);
      cell_of.push_back(table.findOrAdd(cube));
    }
    count.assign(static_cast<std::size_t>(table.size()), 0);
    for (const int cell : cell_of) ++count[cell];
  }
  void write(std::vector<int>* sorted) {
    for (std::size_t i = 0; i < points.size(); ++i) (*sorted)[next[cell_of[i]]++] = points[i];
  }

  CellNumbering table;
  std::vector<int> points, cell_of;
  std::vector<int> count, number, next;  // per cell: points, cell of all parts, place of the next
};

}  // namespace

SurfaceCells::SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm, double cell_mm,
                           const SurfaceRegion& region)
    : cell_mm_(cell_mm), table_(cell_mm) {
  sortPoints(positions_mm, region);
  findCentres(positions_mm);
  findNeighbours();
}

/// Parts of the points are numbered on their own; then their cubes, part after part.
void SurfaceCells::sortPoints(const std::vector<Eigen::Vector3f>& positions_mm,
                              const SurfaceRegion& region) {
  const int count = static_cast<int>(positions_mm.size());
  std::vector<PartOfPoints> parts(
      static_cast<std::size_t>((count + kPointsPerTask - 1) / kPointsPerTask),
      PartOfPoints(cell_mm_));
  const auto forEachPart = [&](const auto& body) {
    parallelRanges(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
      for (int part = begin; part < end; ++part) body(part);
    });
  };
  forEachPart([&](int part) {
    const int begin = part * kPointsPerTask;
    parts[part].take(positions_mm, begin, std::min(count, begin + kPointsPerTask), region);
  });
  std::vector<int> next;  // count of each cell, then the place of its next point
  for (PartOfPoints& part : parts)
    for (int cell = 0; cell < part.table.size(); ++cell) {
      part.number.push_back(table_.findOrAdd(part.table.cube(cell)));
      next.resize(static_cast<std::size_t>(size()), 0);
      next[part.number[cell]] += part.count[cell];
    }
  int total = 0;
  for (int& place : next) total += std::exchange(place, total);
  first_ = next;
  first_.push_back(total);
  for (PartOfPoints& part : parts)
    for (int cell = 0; cell < part.table.size(); ++cell) {
      int& place = next[part.number[cell]];
      part.next.push_back(place);
      place += part.count[cell];
    }
  points_.resize(static_cast<std::size_t>(total));
  forEachPart([&](int part) { parts[part].write(&points_); });
}

void SurfaceCells::findCentres(const std::vector<Eigen::Vector3f>& positions_mm) {
  centres_.assign(static_cast<std::size_t>(size()), Eigen::Vector3f::Zero());
  representatives_.assign(static_cast<std::size_t>(size()), -1);
  parallelRanges(size(), kCellsPerTask, [&](int begin, int end) {
    for (int cell = begin; cell < end; ++cell) {
      Eigen::Vector3f& centre = centres_[cell];
      visitPoints(cell, [&](int point) { centre += positions_mm[point]; });
      centre /= static_cast<float>(first_[cell + 1] - first_[cell]);
      float closest = std::numeric_limits<float>::max();
      visitPoints(cell, [&](int point) {
        const float distance = (positions_mm[point] - centre).squaredNorm();
        if (distance >= closest) return;
        closest = distance;
        representatives_[cell] = point;
      });
    }
  });
}

void SurfaceCells::findNeighbours() {
  neighbours_.resize(static_cast<std::size_t>(size()));
  parallelRanges(table_.blocks(), kBlocksPerTask, [&](int begin, int end) {
    for (int block = begin; block < end; ++block)
      BlockWithRim(table_, block).visitTouching([&](int cell, int other) {
        Neighbours& around = neighbours_[cell];
        around.cells[around.count++] = other;
      });
  });
}

int SurfaceCells::cellAt(const Eigen::Vector3f& position_mm) const {
  Cube cube;
  return table_.cubeOf(position_mm, &cube) ? table_.find(cube) : -1;
}

int SurfaceCells::cellNear(const Eigen::Vector3f& position_mm) const {
  Cube cube;
  if (!table_.cubeOf(position_mm, &cube)) return -1;
  const int own = table_.find(cube);
  if (own >= 0) return own;
  int closest = -1;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int other = table_.find({cube.x + dx, cube.y + dy, cube.z + dz});
        if (other >= 0 && (closest < 0 || (centre(other) - position_mm).squaredNorm() <
                                              (centre(closest) - position_mm).squaredNorm()))
          closest = other;
      }
  return closest;
}

}  // namespace softscope
