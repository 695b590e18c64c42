#include "deform/graph/surface_cells.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr std::uint64_t kNoCube = ~std::uint64_t{0};  // cubes' keys take 63 bits
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
  const int count = static_cast<int>(points.size());
  std::vector<std::uint64_t> keys(points.size());
  parallelRanges(count, kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      if (!table_.keyOf(positions_mm[points[i]], &keys[i])) keys[i] = kNoCube;
  });
  cell_of_.assign(points.size(), -1);
  std::uint64_t last_key = kNoCube;
  int cell = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keys[i] == kNoCube) continue;
    if (keys[i] != last_key) cell = table_.findOrAdd(keys[i]);  // neighbours share cubes
    last_key = keys[i];
    cell_of_[i] = cell;
  }
  findCentres(positions_mm, points);
  findNeighbours();
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
  constexpr int kMost = 26;
  std::vector<std::array<int, kMost>> found(static_cast<std::size_t>(size()));
  std::vector<int> counts(found.size(), 0);
  parallelRanges(size(), kCellsPerTask, [&](int begin, int end) {
    for (int cell = begin; cell < end; ++cell)
      for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int other = table_.find(CellNumbering::shifted(table_.key(cell), dx, dy, dz));
            if (other >= 0 && other != cell) found[cell][counts[cell]++] = other;
          }
  });
  neighbour_start_.assign(1, 0);
  neighbour_start_.reserve(found.size() + 1);
  for (std::size_t cell = 0; cell < found.size(); ++cell) {
    neighbours_.insert(neighbours_.end(), found[cell].begin(), found[cell].begin() + counts[cell]);
    neighbour_start_.push_back(static_cast<int>(neighbours_.size()));
  }
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
