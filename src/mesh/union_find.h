// src/mesh/union_find.h: disjoint sets.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace softscope {

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t find(std::int32_t i) {
    while (parent_[std::size_t(i)] != i)
      i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) { parent_[std::size_t(find(a))] = find(b); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace softscope
