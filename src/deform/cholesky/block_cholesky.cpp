#include "deform/cholesky/block_cholesky.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {
namespace {

constexpr double kSharedOperations = 1e6;  // minimum operations of a parallel update

}  // namespace

bool BlockCholesky::factor(const std::vector<double>& values, const Damping& damping) {
  factored_ = eliminateAll(root_split_, {values.data(), damping});
  return factored_;
}

bool BlockCholesky::eliminateAll(const WorkSplit& split, const Input& input) {
  const auto run = [&](const std::vector<int>& part) {
    return std::all_of(part.begin(), part.end(), [&](int s) {
      return eliminateAll(splits_[s], input) && eliminateFront(s, input);
    });
  };
  if (!split.parallel) return run(split.parts[0]) && run(split.parts[1]);
  bool done[2] = {false, false};
  parallelInvoke([&] { done[0] = run(split.parts[0]); }, [&] { done[1] = run(split.parts[1]); });
  return done[0] && done[1];
}

bool BlockCholesky::eliminateFront(int supernode, const Input& input) {
  clearFront(supernode);
  addEntries(supernode, input);
  for (const int child : tree_.supernodes[supernode].children) addChild(child, supernode);
  if (!factorPivots(supernode)) return false;
  computeUpdate(supernode);
  return true;
}

/// Element (row, column) of a front, in either part.
double* BlockCholesky::at(int supernode, int row, int column) {
  const Front& front = fronts_[supernode];
  if (column < front.pivots)
    return factor_.data() + front.factor + row +
           static_cast<std::size_t>(column) * front.factor_leading;
  return updates_[front.pool].data() + front.update + (row - front.pivots) +
         static_cast<std::size_t>(column - front.pivots) * front.update_leading;
}

void BlockCholesky::clearFront(int supernode) {
  const Front& front = fronts_[supernode];
  std::fill_n(factor_.begin() + static_cast<std::ptrdiff_t>(front.factor),
              static_cast<std::size_t>(front.factor_leading) * front.pivots, 0.0);
  std::fill_n(updates_[front.pool].begin() + static_cast<std::ptrdiff_t>(front.update),
              static_cast<std::size_t>(front.update_leading) * front.updateRows(), 0.0);
}

void BlockCholesky::addEntries(int supernode, const Input& input) {
  const int leading = fronts_[supernode].factor_leading;
  const int n = block_size_;
  for (int e = entry_start_[supernode]; e < entry_start_[supernode + 1]; ++e) {
    const Entry& entry = entries_[e];
    const double* source = input.values + static_cast<std::size_t>(entry.block) * n * n;
    double* target = at(supernode, entry.row, entry.column);
    const double factor = entry.diagonal ? 1 + input.damping.relative : 1.0;
    for (int c = 0; c < n; ++c)
      for (int r = 0; r < n; ++r)
        target[r + static_cast<std::ptrdiff_t>(c) * leading] +=
            factor * (entry.transposed ? source[c + r * n] : source[r + c * n]);
    if (entry.diagonal)
      for (int r = 0; r < n; ++r)
        target[r + static_cast<std::ptrdiff_t>(r) * leading] += input.damping.absolute;
  }
}

void BlockCholesky::addChild(int child, int supernode) {
  const Front& from = fronts_[child];
  const int n = block_size_;
  const int blocks = static_cast<int>(from.parent_block.size());
  for (int column = 0; column < blocks * n; ++column) {
    const double* source = at(child, from.pivots, from.pivots + column);
    double* target = at(supernode, 0, from.parent_block[column / n] * n + column % n);
    for (int block = column / n; block < blocks; ++block) {
      double* to = target + from.parent_block[block] * n;
      const double* some = source + block * n;
      for (int r = 0; r < n; ++r) to[r] += some[r];
    }
  }
}

/// Left-looking, six columns at a time.
bool BlockCholesky::factorPivots(int supernode) {
  const DeformKernels& kernels = deformKernels();
  const Front& front = fronts_[supernode];
  for (int c = 0; c < front.pivots; c += kTileColumns) {
    double* corner = at(supernode, c, c);
    const double* left = at(supernode, c, 0);
    kernels.updateColumns(corner, front.factor_leading, left, left, front.factor_leading,
                          front.rows - c, c);
    if (!kernels.factorColumns(corner, front.factor_leading, front.rows - c, 0.0)) return false;
  }
  return true;
}

void BlockCholesky::computeUpdate(int supernode) {
  const DeformKernels& kernels = deformKernels();
  const Front& front = fronts_[supernode];
  const auto updateTiles = [&](int begin, int end) {
    for (int c = front.pivots + begin * kTileColumns; c < front.pivots + end * kTileColumns;
         c += kTileColumns) {
      const double* left = at(supernode, c, 0);
      kernels.updateColumns(at(supernode, c, c), front.update_leading, left, left,
                            front.factor_leading, front.rows - c, front.pivots);
    }
  };
  const int tiles = front.updateRows() / kTileColumns;
  const double work = front.pivots * std::pow(front.updateRows(), 2) / 2;
  if (work < kSharedOperations)
    updateTiles(0, tiles);
  else
    parallelRanges(tiles, 4, updateTiles);
}

}  // namespace softscope
