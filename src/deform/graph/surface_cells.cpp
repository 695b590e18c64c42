#include "deform/graph/surface_cells.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kCellsPerTask = 512;
constexpr int kBlocksPerTask = 8;

}  // namespace

SurfaceCells::SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm,
                           const std::vector<int>& points, double cell_mm)
    : cell_mm_(cell_mm), table_(cell_mm) {
  findCentres(positions_mm, sortByCell(positions_mm, points));
  findNeighbours();
}

/// Parts of the points are numbered on their own; then their cubes, part after part.
SurfaceCells::SortedPoints SurfaceCells::sortByCell(
    const std::vector<Eigen::Vector3f>& positions_mm, const std::vector<int>& points) {
  struct Part {
    CellNumbering table;
    std::vector<int> count, number, next;  // per cell of the part: points, cell, place of the next
  };
  const int count = static_cast<int>(points.size());
  std::vector<Part> parts(static_cast<std::size_t>((count + kPointsPerTask - 1) / kPointsPerTask),
                          Part{CellNumbering(cell_mm_), {}, {}, {}});
  const auto forEachPart = [&](const auto& body) {
    parallelRanges(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
      for (int p = begin; p < end; ++p)
        body(parts[p], p * kPointsPerTask, std::min(count, (p + 1) * kPointsPerTask));
    });
  };
  cell_of_.resize(points.size());
  forEachPart([&](Part& part, int begin, int end) {
    Cube cube;
    for (int i = begin; i < end; ++i) {
      cell_of_[i] = table_.cubeOf(positions_mm[points[i]], &cube) ? part.table.findOrAdd(cube) : -1;
      if (cell_of_[i] == static_cast<int>(part.count.size())) part.count.push_back(0);
      if (cell_of_[i] >= 0) ++part.count[cell_of_[i]];
    }
  });
  std::vector<int> next;  // place per cell
  for (Part& part : parts)
    for (int cell = 0; cell < part.table.size(); ++cell) {
      part.number.push_back(table_.findOrAdd(part.table.cube(cell)));
      next.resize(static_cast<std::size_t>(size()), 0);
      next[part.number[cell]] += part.count[cell];
    }
  SortedPoints sorted;
  int total = 0;
  for (int& place : next) total += std::exchange(place, total);
  sorted.first = next;
  sorted.first.push_back(total);
  sorted.points.resize(static_cast<std::size_t>(total));
  for (Part& part : parts)
    for (int cell = 0; cell < part.table.size(); ++cell) {
      int& place = next[part.number[cell]];
      part.next.push_back(place);
      place += part.count[cell];
    }
  forEachPart([&](Part& part, int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (cell_of_[i] < 0) continue;
      sorted.points[part.next[cell_of_[i]]++] = points[i];
      cell_of_[i] = part.number[cell_of_[i]];
    }
  });
  return sorted;
}

void SurfaceCells::findCentres(const std::vector<Eigen::Vector3f>& positions_mm,
                               const SortedPoints& sorted) {
  centres_.assign(static_cast<std::size_t>(size()), Eigen::Vector3f::Zero());
  representatives_.assign(static_cast<std::size_t>(size()), -1);
  parallelRanges(size(), kCellsPerTask, [&](int begin, int end) {
    for (int cell = begin; cell < end; ++cell) {
      const int *const first = sorted.points.data() + sorted.first[cell],
                       *const last = sorted.points.data() + sorted.first[cell + 1];
      Eigen::Vector3f& centre = centres_[cell];
      for (const int* point = first; point < last; ++point) centre += positions_mm[*point];
      centre /= static_cast<float>(last - first);
      float closest = std::numeric_limits<float>::max();
      for (const int* point = first; point < last; ++point) {
        const float distance = (positions_mm[*point] - centre).squaredNorm();
        if (distance >= closest) continue;
        closest = distance;
        representatives_[cell] = *point;
      }
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
