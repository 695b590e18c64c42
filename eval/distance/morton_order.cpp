// eval/distance/morton_order.cpp: ten bits per axis, interleaved, radix sort.
#include "eval/distance/morton_order.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kBitsPerAxis = 10;
constexpr std::uint32_t kCells = 1u << kBitsPerAxis;
constexpr std::uint32_t kLeftOut = 0xFFFFFFFFu;

struct Entry {
  std::uint32_t code;
  std::uint32_t index;
};

/// Inserts two zeros after each of the ten low bits.
std::uint32_t spreadBits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000FFu;
  x = (x | x << 8) & 0x0300F00Fu;
  x = (x | x << 4) & 0x030C30C3u;
  return (x | x << 2) & 0x09249249u;
}

std::uint32_t mortonCode(const Eigen::Vector3f& cell) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float clamped = std::min(std::max(cell[axis], 0.0f), kCells - 1.0f);
    code |= spreadBits(static_cast<std::uint32_t>(clamped)) << axis;
  }
  return code;
}

bool usable(const Eigen::Vector3f& point_mm) {
  return point_mm.allFinite() && point_mm.cwiseAbs().maxCoeff() <= kFarthestPoint_mm;
}

/// One stable pass of a radix sort, by ten bits from `shift` on.
void sortBy(int shift, const std::vector<Entry>& in, std::vector<Entry>& out) {
  std::array<std::uint32_t, kCells> place{};
  for (const Entry& e : in) ++place[(e.code >> shift) % kCells];
  std::uint32_t sum = 0;
  for (std::uint32_t& p : place) sum += std::exchange(p, sum);
  for (const Entry& e : in) out[place[(e.code >> shift) % kCells]++] = e;
}

}  // namespace

std::vector<std::uint32_t> mortonOrder(const std::vector<Eigen::Vector3f>& points_mm,
                                       const Eigen::Vector3f& low_mm,
                                       const Eigen::Vector3f& high_mm) {
  const float extent_mm = std::max((high_mm - low_mm).maxCoeff(), 1e-6f);
  const float cells_per_mm = kCells / extent_mm;
  std::vector<Entry> entries(points_mm.size()), spare(points_mm.size());
  parallelRanges(static_cast<int>(points_mm.size()), 8192, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      entries[i] = {
          usable(points_mm[i]) ? mortonCode((points_mm[i] - low_mm) * cells_per_mm) : kLeftOut,
          static_cast<std::uint32_t>(i)};
  });
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [](const Entry& e) { return e.code == kLeftOut; }),
                entries.end());
  spare.resize(entries.size());
  sortBy(0, entries, spare);
  sortBy(kBitsPerAxis, spare, entries);
  sortBy(2 * kBitsPerAxis, entries, spare);

  std::vector<std::uint32_t> order(spare.size());
  std::transform(spare.begin(), spare.end(), order.begin(), [](const Entry& e) { return e.index; });
  return order;
}

}  // namespace softscope
