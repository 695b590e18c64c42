#include "deform/block_cholesky.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "deform/block_ordering.h"
#include "deform/kernels.h"

namespace softscope {
namespace {

constexpr int kTileColumns = 6;            // of the kernels
constexpr double kTaskOperations = 2e5;    // a subtree with fewer is not worth a thread
constexpr double kSharedOperations = 1e6;  // nor is a front's update

/// Room for the kernels' overhang of 3 rows, and not a multiple of 64 bytes, so that columns don't
/// all fall onto the same cache sets.
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
  deals_.clear();
  for (const Supernode& node : tree_.supernodes) deals_.push_back(deal(node.children));
  root_deal_ = deal(tree_.roots);
  const PoolTops tops = placeUpdates(root_deal_, {0, 0}, 0);
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

/// Heaviest subtree first, each to the hand that has less so far.
BlockCholesky::Deal BlockCholesky::deal(const std::vector<int>& subtrees) const {
  const auto cost = [&](int s) { return tree_.supernodes[s].operations; };
  std::vector<int> sorted = subtrees;
  std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return cost(a) > cost(b); });
  Deal dealt;
  double load[2] = {0, 0};
  for (const int s : sorted) {
    const int hand = load[1] < load[0] ? 1 : 0;
    dealt.hands[hand].push_back(s);
    load[hand] += cost(s);
  }
  const double scalar = std::pow(block_size_, 3);
  dealt.parallel = std::min(load[0], load[1]) * scalar > kTaskOperations;
  return dealt;
}

/// A front's update lives until its parent has added it. Updates of even and odd depth lie in two
/// pools, each used like a stack: when a front is eliminated its children lie in the other pool and
/// its grandchildren are gone, so nothing has to move. What may run at the same time lies apart.
BlockCholesky::PoolTops BlockCholesky::placeUpdates(const Deal& dealt, PoolTops base, int depth) {
  const int pool = depth % 2;
  PoolTops high = base;
  for (const auto& hand : dealt.hands) {
    for (const int s : hand) {
      Front& front = fronts_[s];
      const PoolTops below = placeUpdates(deals_[s], base, depth + 1);
      front.pool = pool;
      front.update = base[pool];
      base[pool] += static_cast<std::size_t>(front.update_leading) * front.updateRows();
      for (int p = 0; p < 2; ++p) high[p] = std::max({high[p], below[p], base[p]});
    }
    if (dealt.parallel) base = high;
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

bool BlockCholesky::factor(const std::vector<double>& values, const Damping& damping) {
  factored_ = eliminateAll(root_deal_, {values.data(), damping});
  return factored_;
}

bool BlockCholesky::eliminateAll(const Deal& dealt, const Input& input) {
  const auto run = [&](const std::vector<int>& hand) {
    return std::all_of(hand.begin(), hand.end(), [&](int s) {
      return eliminateAll(deals_[s], input) && eliminateFront(s, input);
    });
  };
  if (!dealt.parallel) return run(dealt.hands[0]) && run(dealt.hands[1]);
  bool done[2] = {false, false};
  parallelInvoke([&] { done[0] = run(dealt.hands[0]); }, [&] { done[1] = run(dealt.hands[1]); });
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

/// Element (row, column) of a front, whichever part it lies in.
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

Eigen::VectorXd BlockCholesky::solve(const Eigen::VectorXd& rhs) const {
  if (!factored_) throw Error("BlockCholesky: solve() needs a factor() that succeeded");
  const int n = block_size_;
  Eigen::VectorXd x(rhs.size());
  for (std::size_t k = 0; k < tree_.order.size(); ++k)
    x.segment(static_cast<Eigen::Index>(k) * n, n) = rhs.segment(tree_.order[k] * n, n);
  std::vector<double> gathered(static_cast<std::size_t>(largest_update_));
  const int count = static_cast<int>(fronts_.size());
  for (int s = 0; s < count; ++s) forward(s, x.data(), gathered.data());
  for (int s = count - 1; s >= 0; --s) backward(s, x.data(), gathered.data());
  Eigen::VectorXd out(rhs.size());
  for (std::size_t k = 0; k < tree_.order.size(); ++k)
    out.segment(tree_.order[k] * n, n) = x.segment(static_cast<Eigen::Index>(k) * n, n);
  return out;
}

void BlockCholesky::forward(int supernode, double* x, double* gathered) const {
  const DeformKernels& kernels = deformKernels();
  const Front& front = fronts_[supernode];
  const Supernode& node = tree_.supernodes[supernode];
  const int leading = front.factor_leading;
  const double* base = factor_.data() + front.factor;
  double* own = x + static_cast<std::ptrdiff_t>(node.first) * block_size_;
  for (int c = 0; c < front.pivots; c += kTileColumns) {
    const int below = c + kTileColumns;
    const double* columns = base + static_cast<std::ptrdiff_t>(c) * leading;
    for (int j = c; j < below; ++j) {
      const double* column = base + static_cast<std::ptrdiff_t>(j) * leading;
      own[j] /= column[j];
      for (int i = j + 1; i < below; ++i) own[i] -= column[i] * own[j];
    }
    kernels.multiplySubtract(columns + below, leading, front.pivots - below, kTileColumns, own + c,
                             own + below);
  }
  const int update = front.updateRows();
  std::fill(gathered, gathered + update, 0.0);
  kernels.multiplySubtract(base + front.pivots, leading, update, front.pivots, own, gathered);
  for (std::size_t b = 0; b < node.rows.size(); ++b)
    for (int r = 0; r < block_size_; ++r)
      x[static_cast<std::ptrdiff_t>(node.rows[b]) * block_size_ + r] +=
          gathered[b * block_size_ + r];
}

void BlockCholesky::backward(int supernode, double* x, double* gathered) const {
  const DeformKernels& kernels = deformKernels();
  const Front& front = fronts_[supernode];
  const Supernode& node = tree_.supernodes[supernode];
  const int leading = front.factor_leading;
  const double* base = factor_.data() + front.factor;
  double* own = x + static_cast<std::ptrdiff_t>(node.first) * block_size_;
  for (std::size_t b = 0; b < node.rows.size(); ++b)
    for (int r = 0; r < block_size_; ++r)
      gathered[b * block_size_ + r] =
          x[static_cast<std::ptrdiff_t>(node.rows[b]) * block_size_ + r];
  kernels.multiplyTransposedSubtract(base + front.pivots, leading, front.updateRows(), front.pivots,
                                     gathered, own);
  for (int c = front.pivots - kTileColumns; c >= 0; c -= kTileColumns) {
    const int below = c + kTileColumns;
    kernels.multiplyTransposedSubtract(base + below + static_cast<std::ptrdiff_t>(c) * leading,
                                       leading, front.pivots - below, kTileColumns, own + below,
                                       own + c);
    for (int j = below - 1; j >= c; --j) {
      const double* column = base + static_cast<std::ptrdiff_t>(j) * leading;
      for (int i = j + 1; i < below; ++i) own[j] -= column[i] * own[i];
      own[j] /= column[j];
    }
  }
}

}  // namespace softscope
