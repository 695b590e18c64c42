// eval/simulation/surface/ray_tree_build.cpp: median splits
// along the longest side of the box of the centroids.
#include <algorithm>

#include "eval/simulation/surface/ray_tree.h"

namespace softscope {
namespace {

constexpr int kTrianglesPerLeaf = 4;

struct TreePart {
  Eigen::Array3f middle_mm, low_mm, high_mm;
  std::int32_t triangle;
};

TreePart partOf(const RayTriangle& t, std::int32_t index) {
  const Eigen::Array3f a = t.a_mm.array(), b = a + t.ab_mm.array(), c = a + t.ac_mm.array();
  const Eigen::Array3f low = a.min(b).min(c), high = a.max(b).max(c);
  return {0.5F * (low + high), low, high, index};
}

class Builder {
 public:
  explicit Builder(std::vector<TreePart> parts) : parts_(std::move(parts)) {
    nodes_.reserve(parts_.size());
    build(0, static_cast<int>(parts_.size()));
  }
  std::vector<TreePart> parts_;
  std::vector<RayTreeNode> nodes_;

 private:
  void build(int begin, int end) {
    const std::size_t here = nodes_.size();
    nodes_.emplace_back();
    RayTreeNode node;
    node.low_mm = parts_[begin].low_mm;
    node.high_mm = parts_[begin].high_mm;
    Eigen::Array3f low = parts_[begin].middle_mm, high = low;
    for (int i = begin + 1; i < end; ++i) {
      node.low_mm = node.low_mm.min(parts_[i].low_mm);
      node.high_mm = node.high_mm.max(parts_[i].high_mm);
      low = low.min(parts_[i].middle_mm);
      high = high.max(parts_[i].middle_mm);
    }
    if (end - begin <= kTrianglesPerLeaf) {
      node.begin = begin;
      node.count = static_cast<std::int16_t>(end - begin);
    } else {
      int axis = 0;
      (high - low).maxCoeff(&axis);
      node.axis = static_cast<std::int16_t>(axis);
      const int middle = split(begin, end, axis);
      build(begin, middle);
      node.begin = static_cast<std::int32_t>(nodes_.size());
      build(middle, end);
    }
    nodes_[here] = node;
  }

  int split(int begin, int end, int axis) {
    const int middle = begin + (end - begin) / 2;
    std::nth_element(parts_.begin() + begin, parts_.begin() + middle, parts_.begin() + end,
                     [axis](const TreePart& a, const TreePart& b) {
                       if (a.middle_mm[axis] != b.middle_mm[axis])
                         return a.middle_mm[axis] < b.middle_mm[axis];
                       return a.triangle < b.triangle;
                     });
    return middle;
  }
};

}  // namespace

std::vector<RayTreeNode> buildRayTree(std::vector<RayTriangle>& triangles) {
  std::vector<TreePart> parts;
  parts.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    parts.push_back(partOf(triangles[i], static_cast<std::int32_t>(i)));
  Builder builder(std::move(parts));
  std::vector<RayTriangle> ordered;
  ordered.reserve(triangles.size());
  for (const TreePart& part : builder.parts_) ordered.push_back(triangles[part.triangle]);
  triangles = std::move(ordered);
  return std::move(builder.nodes_);
}

}  // namespace softscope
