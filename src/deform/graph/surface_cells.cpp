#include "deform/graph/surface_cells.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kBits = 21;
constexpr std::int64_t kOrigin = std::int64_t{1} << (kBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

std::uint64_t pack(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (static_cast<std::uint64_t>(z) & kMask) << (2 * kBits) |
         (static_cast<std::uint64_t>(y) & kMask) << kBits | (static_cast<std::uint64_t>(x) & kMask);
}

}  // namespace

int cellsPerThread(int cells) { return std::max(kCellsPerTask, cells / threadCount() + 1); }

CellNumbering::CellNumbering(double cell_mm, int expected_cells) : inverse_cell_(1 / cell_mm) {
  std::size_t capacity = 64;
  while (capacity < 2 * static_cast<std::size_t>(expected_cells)) capacity *= 2;
  slots_.assign(capacity, -1);
}

bool CellNumbering::keyOf(const Eigen::Vector3f& point_mm, std::uint64_t* key) const {
  constexpr double kEnd = static_cast<double>(kOrigin - 64), kFirst = 1 - kEnd;
  std::int64_t index[3];
  for (int c = 0; c < 3; ++c) {
    const double cell = static_cast<double>(point_mm[c]) * inverse_cell_;
    if (!(cell >= kFirst && cell < kEnd)) return false;  // NaN too
    // std::floor is a library call on processors without SSE4.1.
    const std::int64_t whole = static_cast<std::int64_t>(cell);
    index[c] = whole - (static_cast<double>(whole) > cell ? 1 : 0) + kOrigin;
  }
  *key = pack(index[0], index[1], index[2]);
  return true;
}

std::uint64_t CellNumbering::shifted(std::uint64_t key, int dx, int dy, int dz) {
  return pack(static_cast<std::int64_t>(key & kMask) + dx,
              static_cast<std::int64_t>((key >> kBits) & kMask) + dy,
              static_cast<std::int64_t>((key >> (2 * kBits)) & kMask) + dz);
}

std::size_t CellNumbering::slotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
  while (slots_[slot] >= 0 && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
  return slot;
}

int CellNumbering::find(std::uint64_t key) const { return slots_[slotOf(key)]; }

int CellNumbering::findOrAdd(std::uint64_t key) {
  const std::size_t slot = slotOf(key);
  if (slots_[slot] >= 0) return slots_[slot];
  const int cell = size();
  slots_[slot] = cell;
  keys_.push_back(key);
  if (2 * keys_.size() > slots_.size()) grow();
  return cell;
}

void CellNumbering::grow() {
  slots_.assign(2 * slots_.size(), -1);
  for (int cell = 0; cell < size(); ++cell) slots_[slotOf(keys_[cell])] = cell;
}

SurfaceCells::SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm,
                           const std::vector<int>& points, double cell_mm)
    : cell_mm_(cell_mm), table_(cell_mm, static_cast<int>(points.size() / 16)) {
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
    std::uint64_t key = 0;
    cell_of_[i] = table_.keyOf(positions_mm[points[i]], &key) ? own[part].findOrAdd(key) : -1;
  });
  std::vector<std::vector<int>> numbers(own.size());
  for (std::size_t part = 0; part < own.size(); ++part)
    for (int cube = 0; cube < own[part].size(); ++cube)
      numbers[part].push_back(table_.findOrAdd(own[part].key(cube)));
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
    for (int cell = begin; cell < end; ++cell) {
      Neighbours& around = neighbours_[cell];
      for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int other = table_.find(CellNumbering::shifted(table_.key(cell), dx, dy, dz));
            if (other >= 0 && other != cell) around.cells[around.count++] = other;
          }
    }
  });
}

int SurfaceCells::cellNear(const Eigen::Vector3f& position_mm) const {
  std::uint64_t key = 0;
  if (!table_.keyOf(position_mm, &key)) return -1;
  const int own = table_.find(key);
  if (own >= 0) return own;
  int closest = -1;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int other = table_.find(CellNumbering::shifted(key, dx, dy, dz));
        if (other < 0) continue;
        if (closest < 0 || (centre(other) - position_mm).squaredNorm() <
                               (centre(closest) - position_mm).squaredNorm())
          closest = other;
      }
  return closest;
}

}  // namespace softscope
