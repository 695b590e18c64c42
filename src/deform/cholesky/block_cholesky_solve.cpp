// src/deform/cholesky/block_cholesky_solve.cpp: forward and backward substitution.
#include <algorithm>

#include "core/error.h"
#include "deform/cholesky/block_cholesky.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {

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
