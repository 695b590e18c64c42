#include "deform/cholesky/block_ordering.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace softscope {

std::vector<int> fillReducingOrder(const BlockPattern& pattern) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < pattern.nodes(); ++j)
    for (int b = pattern.column_start[j]; b < pattern.column_start[j + 1]; ++b) {
      entries.emplace_back(pattern.row[b], j, 1.0);
      if (pattern.row[b] != j) entries.emplace_back(j, pattern.row[b], 1.0);
    }
  Eigen::SparseMatrix<double> matrix(pattern.nodes(), pattern.nodes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  if (pattern.nodes() > 0) Eigen::AMDOrdering<int>()(matrix, permutation);
  const auto& indices = permutation.indices();
  return std::vector<int>(indices.data(), indices.data() + indices.size());
}

}  // namespace softscope
