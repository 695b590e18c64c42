// src/deform/cholesky/block_cholesky_analysis.cpp: symbolic analysis: memory layout of the factor.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "deform/cholesky/block_cholesky.h"
#include "deform/cholesky/block_ordering.h"

namespace softscope {
namespace {

constexpr double kTaskOperations = 2e5;  // minimum operations of a parallel subtree

/// Includes the overhang of 3 rows of the kernels, and is not a multiple
/// of 64 bytes, so that columns do not map to the same cache sets.
int leadingDimension(int rows) {
  const int padded = (rows + 3 + 3) / 4 * 4;
  return padded % 8 == 0 ? padded + 4 : padded;
}

}  // namespace

void BlockCholesky::analyse(const BlockPattern& pattern, int block_size) {
  require(block_size > 0 && block_size % kTileColumns == 0, "block_size", block_size,
          "must be a multiple of 6");
  block_size_ = block_size;
  factored_ = false;
  tree_ = makeEliminationTree(pattern, fillReducingOrder(pattern));
  layOutFactor();
  mapEntries(pattern);
  splits_.clear();
  for (const Supernode& node : tree_.supernodes) splits_.push_back(splitWork(node.children));
  root_split_ = splitWork(tree_.roots);
  const PoolTops tops = placeUpdates(root_split_, {0, 0}, 0);
  for (int pool = 0; pool < 2; ++pool) updates_[pool].resize(tops[pool]);
}

int BlockCholesky::blockInFront(int supernode, int position) const {
  const Supernode& node = tree_.supernodes[supernode];
  if (position < node.first + node.columns) return position - node.first;
  const auto found = std::lower_bound(node.rows.begin(), node.rows.end(), position);
  return node.columns + static_cast<int>(found - node.rows.begin());
}

void BlockCholesky::layOutFactor() {
  fronts_.assign(tree_.supernodes.size(), Front());
  std::size_t offset = 0;
  largest_update_ = 0;
  for (std::size_t s = 0; s < fronts_.size(); ++s) {
    const Supernode& node = tree_.supernodes[s];
    Front& front = fronts_[s];
    front.pivots = node.columns * block_size_;
    front.rows = front.pivots + static_cast<int>(node.rows.size()) * block_size_;
    front.factor_leading = leadingDimension(front.rows);
    front.update_leading = leadingDimension(front.updateRows());
    front.factor = offset;
    offset += static_cast<std::size_t>(front.factor_leading) * front.pivots;
    largest_update_ = std::max(largest_update_, front.update_leading);
    for (const int position : node.rows)
      front.parent_block.push_back(blockInFront(node.parent, position));
  }
  factor_.assign(offset, 0.0);
}

void BlockCholesky::mapEntries(const BlockPattern& pattern) {
  std::vector<std::vector<Entry>> by_supernode(fronts_.size());
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
      const int p = tree_.position[j], q = tree_.position[pattern.row[b]];
      const int supernode = tree_.supernode_of[std::min(p, q)];
      Entry entry;
      entry.block = b;
      entry.row = blockInFront(supernode, std::max(p, q)) * block_size_;
      entry.column = blockInFront(supernode, std::min(p, q)) * block_size_;
      entry.transposed = q < p;
      entry.diagonal = p == q;
      by_supernode[supernode].push_back(entry);
    }
  entries_.clear();
  entry_start_.assign(1, 0);
  for (const auto& list : by_supernode) {
    entries_.insert(entries_.end(), list.begin(), list.end());
    entry_start_.push_back(static_cast<int>(entries_.size()));
  }
}

/// Heaviest subtree first, each to the thread with less work so far.
BlockCholesky::WorkSplit BlockCholesky::splitWork(const std::vector<int>& subtrees) const {
  const auto cost = [&](int s) { return tree_.supernodes[s].operations; };
  std::vector<int> sorted = subtrees;
  std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return cost(a) > cost(b); });
  WorkSplit split;
  double load[2] = {0, 0};
  for (const int s : sorted) {
    const int part = load[1] < load[0] ? 1 : 0;
    split.parts[part].push_back(s);
    load[part] += cost(s);
  }
  const double scalar = std::pow(block_size_, 3);
  split.parallel = std::min(load[0], load[1]) * scalar > kTaskOperations;
  return split;
}

/// A front's update is kept until its parent has added it. Updates of even and odd depth lie in two
/// pools, each used like a stack: when a front is eliminated its children lie in the other pool and
/// its grandchildren are gone, so nothing has to move. What may run at the same time lies apart.
BlockCholesky::PoolTops BlockCholesky::placeUpdates(const WorkSplit& split, PoolTops base,
                                                    int depth) {
  const int pool = depth % 2;
  PoolTops high = base;
  for (const auto& part : split.parts) {
    for (const int s : part) {
      Front& front = fronts_[s];
      const PoolTops below = placeUpdates(splits_[s], base, depth + 1);
      front.pool = pool;
      front.update = base[pool];
      base[pool] += static_cast<std::size_t>(front.update_leading) * front.updateRows();
      for (int p = 0; p < 2; ++p) high[p] = std::max({high[p], below[p], base[p]});
    }
    if (split.parallel) base = high;
  }
  return high;
}

double BlockCholesky::operations() const {
  double total = 0;
  for (const int root : tree_.roots) total += tree_.supernodes[root].operations;
  return total * std::pow(block_size_, 3);
}

std::size_t BlockCholesky::storedBytes() const {
  return (factor_.size() + updates_[0].size() + updates_[1].size()) * sizeof(double);
}

double BlockCholesky::pivotRatio() const {
  double low = 1e300, high = 0;
  for (const Front& front : fronts_)
    for (int c = 0; c < front.pivots; ++c) {
      const double pivot =
          factor_[front.factor + c + static_cast<std::size_t>(c) * front.factor_leading];
      low = std::min(low, pivot);
      high = std::max(high, pivot);
    }
  return high > 0 ? low / high : 0;
}

}  // namespace softscope
