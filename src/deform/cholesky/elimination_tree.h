// src/deform/cholesky/elimination_tree.h: elimination tree and structure of the Cholesky factor, by
// symbolic analysis.
#pragma once

#include <vector>

#include "deform/cholesky/block_pattern.h"

namespace softscope {

/// Neighbouring columns of the factor with equal rows: one dense front.
struct Supernode {
  int first = 0;              // position of its first column in the elimination order
  int columns = 0;            // number of eliminated nodes
  std::vector<int> rows;      // non-zero positions below it, ascending
  int parent = -1;            // the supernode that receives its update; -1 at a root
  std::vector<int> children;  // ascending
  double operations = 0;      // multiply-adds on blocks, its subtree included
};

/// Supernodes in postorder: children before their parents.
struct EliminationTree {
  std::vector<int> order;     // order[position] = node
  std::vector<int> position;  // position[node]
  std::vector<Supernode> supernodes;
  std::vector<int> supernode_of;  // of each position
  std::vector<int> roots;
};

/// `order` is a fill-reducing order; the tree's own is a postorder of it with the same fill.
EliminationTree makeEliminationTree(const BlockPattern& pattern, const std::vector<int>& order);

}  // namespace softscope
