#include "deform/graph/surface_cells.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"

namespace softscope {

int cellsPerThread(int cells) { return std::max(kCellsPerTask, cells / threadCount() + 1); }

SurfaceCells::SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm,
                           const std::vector<int>& points, double cell_mm)
    : cell_mm_(cell_mm), table_(cell_mm) {
  numberCubes(positions_mm, points);
  findCentres(positions_mm, points);
  findNeighbours();
}

/// Parts of the points are numbered on their own; then their cubes, part after part.
void SurfaceCells::numberCubes(const std::vector<Eigen::Vector3f>& positions_mm,
                               const std::vector<int>& points) {
  const int count = static_cast<int>(points.size());
  const int parts = (count + kPointsPerTask - 1) / kPointsPerTask;
  cell_of_.resize(points.size());
  std::vector<CellNumbering> own(static_cast<std::size_t>(parts), CellNumbering(cell_mm_));
  const auto forEachPoint = [&](const auto& body) {
    parallelRanges(parts, 1, [&](int begin, int end) {
      for (int part = begin; part < end; ++part)
        for (int i = part * kPointsPerTask; i < std::min(count, (part + 1) * kPointsPerTask); ++i)
          body(part, i);
    });
  };
  forEachPoint([&](int part, int i) {
    Cube cube;
    cell_of_[i] = table_.cubeOf(positions_mm[points[i]], &cube) ? own[part].findOrAdd(cube) : -1;
  });
  std::vector<std::vector<int>> numbers(own.size());
  for (std::size_t part = 0; part < own.size(); ++part)
    for (int cell = 0; cell < own[part].size(); ++cell)
      numbers[part].push_back(table_.findOrAdd(own[part].cube(cell)));
  forEachPoint([&](int part, int i) {
    if (cell_of_[i] >= 0) cell_of_[i] = numbers[part][cell_of_[i]];
  });
}

/// Every task visits all points and handles those of its own cells, in the order of the points.
void SurfaceCells::findCentres(const std::vector<Eigen::Vector3f>& positions_mm,
                               const std::vector<int>& points) {
  const std::size_t cells = static_cast<std::size_t>(size());
  centres_.assign(cells, Eigen::Vector3f::Zero());
  representatives_.assign(cells, -1);
  std::vector<int> counts(cells, 0);
  std::vector<float> closest(cells, std::numeric_limits<float>::max());
  parallelRanges(size(), cellsPerThread(size()), [&](int begin, int end) {
    const auto is_own = [&](int cell) { return cell >= begin && cell < end; };
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_own(cell_of_[i])) continue;
      centres_[cell_of_[i]] += positions_mm[points[i]];
      ++counts[cell_of_[i]];
    }
    for (int c = begin; c < end; ++c) centres_[c] /= static_cast<float>(counts[c]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int cell = cell_of_[i];
      if (!is_own(cell)) continue;
      const float distance = (positions_mm[points[i]] - centres_[cell]).squaredNorm();
      if (distance >= closest[cell]) continue;
      closest[cell] = distance;
      representatives_[cell] = points[i];
    }
  });
}

void SurfaceCells::findNeighbours() {
  neighbours_.resize(static_cast<std::size_t>(size()));
  parallelRanges(size(), kCellsPerTask, [&](int begin, int end) {
    NeighbourFinder finder(table_);
    for (int cell = begin; cell < end; ++cell) {
      Neighbours& around = neighbours_[cell];
      finder.visit(table_.cube(cell), [&](int other) { around.cells[around.count++] = other; });
    }
  });
}

int SurfaceCells::cellNear(const Eigen::Vector3f& position_mm) const {
  Cube cube;
  if (!table_.cubeOf(position_mm, &cube)) return -1;
  const int own = table_.find(cube);
  if (own >= 0) return own;
  int closest = -1;
  NeighbourFinder(table_).visit(cube, [&](int other) {
    if (closest < 0 ||
        (centre(other) - position_mm).squaredNorm() < (centre(closest) - position_mm).squaredNorm())
      closest = other;
  });
  return closest;
}

}  // namespace softscope
