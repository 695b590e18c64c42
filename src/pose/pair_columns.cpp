#include "pose/pair_columns.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kBlock = 256;  // pairs whose columns stay in the nearest cache

constexpr int kBlocksPerTask = 4;

using Column = Eigen::Array<double, Eigen::Dynamic, 1, 0, kBlock, 1>;  // no memory of its own

bool isUsable(const PointPairs& pairs, std::size_t i) {
  const float weight = pairs.weight(i);
  return pairs.sources_mm[i].allFinite() && pairs.targets_mm[i].allFinite() && weight > 0 &&
         std::isfinite(weight);
}

/// Calls `work(begin, count)` for one block after another while it returns true.
template <class Work>
void forBlocks(int size, const Work& work) {
  for (int begin = 0; begin < size; begin += kBlock)
    if (!work(begin, std::min(kBlock, size - begin))) return;
}

}  // namespace

PairColumns::PairColumns(const PointPairs& pairs) {
  pairs_.reserve(pairs.sources_mm.size());
  for (std::size_t i = 0; i < pairs.sources_mm.size(); ++i)
    if (isUsable(pairs, i)) pairs_.push_back(i);
  weights_.resize(size());
  for (int c = 0; c < 3; ++c) {
    source_[c].resize(size());
    target_[c].resize(size());
  }
  parallelRanges(size(), kBlocksPerTask * kBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      weights_[i] = pairs.weight(pair(i));
      for (int c = 0; c < 3; ++c) {
        source_[c][i] = pairs.sources_mm[pair(i)][c];
        target_[c][i] = pairs.targets_mm[pair(i)][c];
      }
    }
  });
}

void PairColumns::squaresIn(const Eigen::Isometry3f& target_from_source, int begin, int count,
                            float* squares) const {
  const Eigen::Matrix<float, 3, 4> rows = target_from_source.affine();
  for (int c = 0; c < 3; ++c) {
    const float *x = source_[0].data() + begin, *y = source_[1].data() + begin,
                *z = source_[2].data() + begin, *target = target_[c].data() + begin;
    const float by_x = rows(c, 0), by_y = rows(c, 1), by_z = rows(c, 2), shift = rows(c, 3);
    for (int i = 0; i < count; ++i) {
      const float apart = by_x * x[i] + by_y * y[i] + by_z * z[i] + shift - target[i];
      squares[i] = c == 0 ? apart * apart : squares[i] + apart * apart;
    }
  }
}

Eigen::ArrayXf PairColumns::squaredDistances(const Eigen::Isometry3f& target_from_source) const {
  Eigen::ArrayXf squares(size());
  forBlocks(size(), [&](int begin, int count) {
    squaresIn(target_from_source, begin, count, squares.data() + begin);
    return true;
  });
  return squares;
}

double PairColumns::truncatedScore(const Eigen::Isometry3f& target_from_source, float limit,
                                   double best) const {
  Eigen::Array<float, kBlock, 1> squares;
  double score = 0;
  forBlocks(size(), [&](int begin, int count) {
    squaresIn(target_from_source, begin, count, squares.data());
    score += squares.head(count).min(limit).cast<double>().sum();
    return score < best;
  });
  return score;
}

PairSums PairColumns::sumsInBlock(const Eigen::ArrayXf& squares, float limit, int begin) const {
  const int count = std::min(kBlock, size() - begin);
  const Column weights = (squares.segment(begin, count) <= limit)
                             .select(weights_.segment(begin, count), 0.0f)
                             .cast<double>();
  std::array<Column, 3> source, target;
  for (int c = 0; c < 3; ++c) {
    source[c] = source_[c].segment(begin, count).cast<double>();
    target[c] = target_[c].segment(begin, count).cast<double>();
  }
  PairSums sums;
  sums.weight = weights.sum();
  for (int c = 0; c < 3; ++c) {
    const Column weighted_source = weights * source[c], weighted_target = weights * target[c];
    sums.source[c] = weighted_source.sum();
    sums.target[c] = weighted_target.sum();
    for (int d = 0; d < 3; ++d) {
      sums.cross(c, d) = (weighted_target * source[d]).sum();
      if (d <= c) sums.squares(c, d) = (weighted_source * source[d]).sum();
    }
  }
  return sums;
}

/// The order of the sums does not depend on threads.
PairSums PairColumns::sumsWithin(const Eigen::ArrayXf& squares, float limit) const {
  std::vector<PairSums> blocks(static_cast<std::size_t>((size() + kBlock - 1) / kBlock));
  parallelRanges(static_cast<int>(blocks.size()), kBlocksPerTask, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) blocks[k] = sumsInBlock(squares, limit, k * kBlock);
  });
  PairSums sums;
  for (const PairSums& block : blocks) {
    sums.weight += block.weight;
    sums.source += block.source;
    sums.target += block.target;
    sums.cross += block.cross;
    sums.squares += block.squares;
  }
  sums.squares.triangularView<Eigen::StrictlyUpper>() = sums.squares.transpose();
  return sums;
}

}  // namespace softscope
