// eval/distance/tree_build.cpp: median splits into full leaves, then boxes bottom-up.
#include "eval/distance/tree_build.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

using Box = Eigen::AlignedBox3f;

/// Triangle during sorting.
struct Item {
  std::array<float, 3> centre_mm;  // of its box
  std::int32_t triangle;
};

Box boxOf(const TriangleMesh& mesh, std::int32_t triangle) {
  Box box;
  for (const std::int32_t vertex : mesh.triangles[triangle]) box.extend(mesh.vertices_mm[vertex]);
  return box;
}

std::vector<Item> makeItems(const TriangleMesh& mesh) {
  std::vector<Item> items(mesh.triangles.size());
  parallelRanges(static_cast<int>(items.size()), 4096, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3f centre = boxOf(mesh, i).center();
      items[i] = {{centre.x(), centre.y(), centre.z()}, i};
    }
  });
  return items;
}

int widestAxis(const Item* items, long count) {
  std::array<float, 3> low = items[0].centre_mm, high = low;
  for (long i = 1; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], items[i].centre_mm[axis]);
      high[axis] = std::max(high[axis], items[i].centre_mm[axis]);
    }
  const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  return x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
}

/// Sorts items so that each run of `run` items, and each of run / 8 within
/// it, down to leaves of 8, is spatially compact, by median splits.
void sortIntoRuns(Item* items, long count, long run) {
  constexpr long kMinTaskTriangles = 4096;
  if (count <= kTreeWidth) return;
  if (count <= run) return sortIntoRuns(items, count, run / kTreeWidth);
  const long runs = (count + run - 1) / run, left = (runs + 1) / 2 * run;
  const int axis = widestAxis(items, count);
  std::nth_element(items, items + left, items + count, [axis](const Item& a, const Item& b) {
    const float x = a.centre_mm[axis], y = b.centre_mm[axis];
    return x < y || (x == y && a.triangle < b.triangle);
  });
  const auto first = [=] { sortIntoRuns(items, left, run); };
  const auto second = [=] { sortIntoRuns(items + left, count - left, run); };
  if (count >= kMinTaskTriangles) return parallelInvoke(first, second);
  first();
  second();
}

/// Corners of a triangle in double, with A to B the longest edge.
struct Corners {
  Eigen::Vector3d a, b, c;
};

Corners cornersOf(const TriangleMesh& mesh, std::int32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Eigen::Vector3d v[3] = {mesh.vertices_mm[t[0]].cast<double>(),
                                mesh.vertices_mm[t[1]].cast<double>(),
                                mesh.vertices_mm[t[2]].cast<double>()};
  int longest = 0;
  for (int i = 1; i < 3; ++i)
    if ((v[(i + 1) % 3] - v[i]).squaredNorm() > (v[(longest + 1) % 3] - v[longest]).squaredNorm())
      longest = i;
  return {v[longest], v[(longest + 1) % 3], v[(longest + 2) % 3]};
}

void putAxis(float (&lanes)[3][kTreeWidth], int lane, const Eigen::Vector3d& axis) {
  for (int i = 0; i < 3; ++i) lanes[i][lane] = static_cast<float>(axis[i]);
}

float inverseOrZero(double value) { return value > 0 ? static_cast<float>(1 / value) : 0; }

/// Writes one lane; a degenerate triangle also gets a
/// frame that contains it. Returns the longest edge, mm.
double putTriangle(const TriangleMesh& mesh, std::int32_t triangle, TreeLeaf& leaf, int lane) {
  const Corners t = cornersOf(mesh, triangle);
  const Eigen::Vector3d ab = t.b - t.a, ac = t.c - t.a, normal = ab.cross(ac);
  const double length = ab.norm();
  const Eigen::Vector3d x = length > 0 ? Eigen::Vector3d(ab / length) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d z = normal.squaredNorm() > 0 ? normal.normalized() : x.unitOrthogonal();
  const Eigen::Vector3d y = z.cross(x).normalized();
  const double cx = ac.dot(x), cy = ac.dot(y);
  putAxis(leaf.origin, lane, t.a);
  putAxis(leaf.axis_x, lane, x);
  putAxis(leaf.axis_y, lane, y);
  putAxis(leaf.axis_z, lane, z);
  leaf.ab[lane] = static_cast<float>(length);
  leaf.cx[lane] = static_cast<float>(cx);
  leaf.cy[lane] = static_cast<float>(cy);
  leaf.inverse_ac2[lane] = inverseOrZero(cx * cx + cy * cy);
  leaf.inverse_bc2[lane] = inverseOrZero((cx - length) * (cx - length) + cy * cy);
  leaf.triangle[lane] = triangle;
  return length;
}

/// Packs sorted items; also returns the box of each leaf and the longest edge of the mesh.
std::vector<TreeLeaf> makeLeaves(const TriangleMesh& mesh, const std::vector<Item>& items,
                                 std::vector<Box>& boxes, double& longest_edge_mm) {
  const int count = static_cast<int>(items.size());
  std::vector<TreeLeaf> leaves((items.size() + kTreeWidth - 1) / kTreeWidth);
  std::vector<double> longest(leaves.size(), 0.0);
  boxes.assign(leaves.size(), Box());
  parallelRanges(static_cast<int>(leaves.size()), 256, [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int lane = 0; lane < kTreeWidth; ++lane) {
        const std::int32_t triangle = items[std::min(j * kTreeWidth + lane, count - 1)].triangle;
        longest[j] = std::max(longest[j], putTriangle(mesh, triangle, leaves[j], lane));
        boxes[j].extend(boxOf(mesh, triangle));
      }
  });
  longest_edge_mm = *std::max_element(longest.begin(), longest.end());
  return leaves;
}

/// Parent of `count` children from `first` on.
TreeNode makeNode(const std::vector<Box>& boxes, int first, int first_child) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  TreeNode node;
  node.first_child = first_child;
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    const bool present = static_cast<std::size_t>(first + lane) < boxes.size();
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][lane] = present ? boxes[first + lane].min()[axis] : kInfinity;
      node.high[axis][lane] = present ? boxes[first + lane].max()[axis] : -kInfinity;
    }
  }
  return node;
}

/// Level by level, eight boxes per node, until a single node remains.
std::vector<TreeNode> makeNodes(std::vector<Box> boxes) {
  std::vector<TreeNode> nodes;
  int children_begin = 0;  // first node of the level below, as in TreeNode::first_child
  while (true) {
    const int below = static_cast<int>(boxes.size());
    std::vector<Box> parents((boxes.size() + kTreeWidth - 1) / kTreeWidth);
    for (int j = 0; j < static_cast<int>(parents.size()); ++j) {
      nodes.push_back(makeNode(boxes, j * kTreeWidth, children_begin + j * kTreeWidth));
      for (int i = j * kTreeWidth; i < std::min(below, (j + 1) * kTreeWidth); ++i)
        parents[j].extend(boxes[i]);
    }
    if (parents.size() == 1) return nodes;
    children_begin += below;
    boxes = std::move(parents);
  }
}

}  // namespace

TreeMemory buildTree(const TriangleMesh& mesh) {
  std::vector<Item> items = makeItems(mesh);
  long run = kTreeWidth;
  while (run * kTreeWidth < static_cast<long>(items.size())) run *= kTreeWidth;
  sortIntoRuns(items.data(), static_cast<long>(items.size()), run);

  TreeMemory tree;
  std::vector<Box> boxes;
  double longest_edge_mm = 0;
  tree.leaves = makeLeaves(mesh, items, boxes, longest_edge_mm);
  tree.nodes = makeNodes(std::move(boxes));
  tree.slack_mm = kTreeEdgeSlack * static_cast<float>(longest_edge_mm);
  return tree;
}

}  // namespace softscope
