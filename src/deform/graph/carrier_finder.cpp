#include "deform/graph/carrier_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace softscope {
namespace {

/// Sorts four numbers without a branch.
void sortFour(std::array<std::int64_t, kNodesPerPoint>& numbers) {
  static_assert(kNodesPerPoint == 4);
  const auto order = [&](std::size_t i, std::size_t j) {
    const std::int64_t lower = std::min(numbers[i], numbers[j]);
    numbers[j] = std::max(numbers[i], numbers[j]);
    numbers[i] = lower;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
}

}  // namespace

Carriers CarrierFinder::find(int cell, const Eigen::Vector3f& point_mm) {
  sortNodes(cell, point_mm.cast<double>());
  const int used = std::min(count_, kNodesPerPoint);
  // With no further node on the surface, d_max is the expected distance of the next one.
  const double furthest =
      count_ > kNodesPerPoint ? nodes_[kNodesPerPoint].first : nodes_[used - 1].first + spacing_mm_;
  std::array<double, kNodesPerPoint> shares{};
  std::array<std::int64_t, kNodesPerPoint> order;  // node number with its index in `shares`
  order.fill(std::numeric_limits<std::int64_t>::max());
  double total = 0;
  for (int i = 0; i < used; ++i) {
    shares[i] = std::max(1 - nodes_[i].first / furthest, 1e-6);
    total += shares[i];
    order[i] = static_cast<std::int64_t>(nodes_[i].second) * kNodesPerPoint + i;
  }
  sortFour(order);
  Carriers carriers;
  for (int i = 0; i < kNodesPerPoint; ++i) {
    carriers.stencil[i] = static_cast<std::int32_t>(order[std::min(i, used - 1)] / kNodesPerPoint);
    carriers.weights[i] =
        i < used ? static_cast<float>(shares[order[i] % kNodesPerPoint] / total) : 0.0f;
  }
  return carriers;
}

/// Sorts the closest kSorted of the nodes of the cell to the front by distance; of equal ones the
/// lower number first. Starts with the order of the previous point, which is usually the same.
void CarrierFinder::sortNodes(int cell, const Eigen::Vector3d& point_mm) {
  if (cell != cell_) {
    const NodeReach::Near& near = reach_.near(cell);
    for (int i = 0; i < near.count; ++i) nodes_[i].second = near.nodes[i];
    count_ = near.count;
    cell_ = cell;
  }
  for (int i = 0; i < std::min(count_, kSorted); ++i) {
    const int node = nodes_[i].second;
    insert(i, {(graph_.positions_mm[node] - point_mm).norm(), node});
  }
  constexpr double kSurelyFurther = 1 + 1e-12;  // also after the rounding of square roots
  for (int i = kSorted; i < count_; ++i) {
    const int node = nodes_[i].second;
    const double square_mm2 = (graph_.positions_mm[node] - point_mm).squaredNorm();
    const NodeDistance& last = nodes_[kSorted - 1];
    if (square_mm2 > last.first * last.first * kSurelyFurther) continue;
    const NodeDistance candidate = {std::sqrt(square_mm2), node};
    if (!(candidate < last)) continue;
    nodes_[i] = last;
    insert(kSorted - 1, candidate);
  }
}

/// Among the sorted nodes_ [0, end); the one at `end` is overwritten.
void CarrierFinder::insert(int end, const NodeDistance& node) {
  for (; end > 0 && node < nodes_[end - 1]; --end) nodes_[end] = nodes_[end - 1];
  nodes_[end] = node;
}

}  // namespace softscope
