// src/deform/cholesky/block_cholesky.h: sparse block Cholesky solver of the normal equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "deform/cholesky/block_pattern.h"
#include "deform/cholesky/elimination_tree.h"

namespace softscope {

/// Sparse Cholesky of a symmetric positive definite block matrix, multifrontal: each
/// supernode is a dense front whose update is added by its parent. The symbolic part
/// is computed once per pattern. Independent subtrees are eliminated in parallel;
/// every sum has a fixed order, so the result is identical for any number of threads.
class BlockCholesky {
 public:
  static constexpr int kTileColumns = 6;  // block width of the kernels

  /// Damping of the diagonal before factorisation: H(jj) (1 + relative) + absolute I.
  struct Damping {
    double relative = 0;
    double absolute = 0;
  };

  /// block_size: unknowns of a node, a multiple of 6. Throws OptionError otherwise.
  void analyse(const BlockPattern& pattern, int block_size);

  /// `values`: blocks of the pattern, column-major, contiguous. Returns false
  /// unless the matrix is positive definite and finite; solve() is then invalid.
  bool factor(const std::vector<double>& values, const Damping& damping);

  /// x = H^-1 rhs, node by node. Throws Error unless the last factor() returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;

  double operations() const;        // multiply-adds of one factorisation
  std::size_t storedBytes() const;  // of the factor and the fronts' updates
  /// Smallest and largest diagonal entry of the factor: its ratio squared bounds the condition
  /// number from below.
  double pivotRatio() const;

 private:
  /// Dense trapezoid, column-major: columns of the factor, and the update for the parent.
  struct Front {
    int pivots = 0;          // scalar columns that are eliminated here
    int rows = 0;            // scalar rows
    std::size_t factor = 0;  // offset into factor_
    int factor_leading = 0;  // distance between columns
    std::size_t update = 0;  // offset into updates_[pool]
    int update_leading = 0;
    int pool = 0;
    std::vector<int> parent_block;  // position of each update block in the front of the parent

    int updateRows() const { return rows - pivots; }
  };
  /// Subtrees below one supernode (or roots), distributed to two threads.
  struct WorkSplit {
    std::array<std::vector<int>, 2> parts;
    bool parallel = false;
  };
  /// Target of one block of the matrix.
  struct Entry {
    int block = 0;  // number in the pattern
    int row = 0;    // scalar position in the front
    int column = 0;
    bool transposed = false;
    bool diagonal = false;
  };
  using PoolTops = std::array<std::size_t, 2>;

  void layOutFactor();
  void mapEntries(const BlockPattern& pattern);
  WorkSplit splitWork(const std::vector<int>& subtrees) const;
  PoolTops placeUpdates(const WorkSplit& split, PoolTops base, int depth);
  int blockInFront(int supernode, int position) const;

  struct Input {
    const double* values;
    Damping damping;
  };
  bool eliminateAll(const WorkSplit& split, const Input& input);
  bool eliminateFront(int supernode, const Input& input);
  double* at(int supernode, int row, int column);
  void clearFront(int supernode);
  void addEntries(int supernode, const Input& input);
  void addChild(int child, int supernode);
  bool factorPivots(int supernode);
  void computeUpdate(int supernode);
  void forward(int supernode, double* x, double* gathered) const;
  void backward(int supernode, double* x, double* gathered) const;

  int block_size_ = 0;
  bool factored_ = false;
  EliminationTree tree_;
  std::vector<Front> fronts_;
  std::vector<WorkSplit> splits_;  // per supernode: its children
  WorkSplit root_split_;
  std::vector<int> entry_start_;  // per supernode
  std::vector<Entry> entries_;
  std::vector<double> factor_;
  std::array<std::vector<double>, 2> updates_;
  int largest_update_ = 0;
};

}  // namespace softscope
