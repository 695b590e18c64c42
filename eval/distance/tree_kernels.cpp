// eval/distance/tree_kernels.cpp: closest triangle by branch and bound, eight boxes or
// triangles at a time; compiled once per instruction set, named by SOFTSCOPE_SIMD_SET.
#include "eval/distance/tree_kernels.h"

#include <cmath>
#include <cstring>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace softscope {
namespace {

// --- eight lanes ---------------------------------------------------------------------------------

typedef float Float8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));

inline Float8 load(const float* values) {
  Float8 lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}
inline Float8 splat(float value) { return Float8{} + value; }
inline Float8 larger(Float8 a, Float8 b) { return a > b ? a : b; }
inline Float8 smaller(Float8 a, Float8 b) { return a < b ? a : b; }

/// One bit per lane.
inline unsigned bits(Int8 lanes) {
#if defined(__AVX2__)
  __m256 mask;
  std::memcpy(&mask, &lanes, sizeof mask);
  return static_cast<unsigned>(_mm256_movemask_ps(mask));
#elif defined(__SSE2__)
  __m128 mask[2];
  std::memcpy(mask, &lanes, sizeof mask);
  return static_cast<unsigned>(_mm_movemask_ps(mask[0]) | _mm_movemask_ps(mask[1]) << 4);
#else
  unsigned result = 0;
  for (int lane = 0; lane < kTreeWidth; ++lane) result |= (lanes[lane] ? 1u : 0u) << lane;
  return result;
#endif
}

inline float smallestLane(Float8 lanes) {
  float least = lanes[0];
  for (int lane = 1; lane < kTreeWidth; ++lane) least = lanes[lane] < least ? lanes[lane] : least;
  return least;
}

struct Point8 {
  Float8 x, y, z;
};

/// Squared distances to the boxes of the children of a node.
inline Float8 boxDistances2(const TreeNode& node, const Point8& p) {
  const Float8 zero{};
  const Float8 dx = larger(larger(load(node.low[0]) - p.x, p.x - load(node.high[0])), zero);
  const Float8 dy = larger(larger(load(node.low[1]) - p.y, p.y - load(node.high[1])), zero);
  const Float8 dz = larger(larger(load(node.low[2]) - p.z, p.z - load(node.high[2])), zero);
  return dx * dx + dy * dy + dz * dz;
}

inline Float8 along(const float (&axis)[3][kTreeWidth], const Point8& w) {
  return load(axis[0]) * w.x + load(axis[1]) * w.y + load(axis[2]) * w.z;
}

/// Squared distances to the triangles of a leaf: height above the plane, and
/// within the plane the nearest of three edges unless the projection is inside.
inline Float8 triangleDistances2(const TreeLeaf& leaf, const Point8& p) {
  const Float8 zero{}, one = splat(1);
  const Point8 w{p.x - load(leaf.origin[0]), p.y - load(leaf.origin[1]),
                 p.z - load(leaf.origin[2])};
  const Float8 x = along(leaf.axis_x, w), y = along(leaf.axis_y, w), z = along(leaf.axis_z, w);
  const Float8 ab = load(leaf.ab), cx = load(leaf.cx), cy = load(leaf.cy);

  const Float8 ab_x = x - smaller(larger(x, zero), ab);
  const Float8 ac_t = smaller(larger((x * cx + y * cy) * load(leaf.inverse_ac2), zero), one);
  const Float8 ac_x = x - ac_t * cx, ac_y = y - ac_t * cy;
  const Float8 bx = x - ab, ex = cx - ab;
  const Float8 bc_t = smaller(larger((bx * ex + y * cy) * load(leaf.inverse_bc2), zero), one);
  const Float8 bc_x = bx - bc_t * ex, bc_y = y - bc_t * cy;

  const Float8 edge2 =
      smaller(ab_x * ab_x + y * y, smaller(ac_x * ac_x + ac_y * ac_y, bc_x * bc_x + bc_y * bc_y));
  const Int8 inside = (y > zero) & (x * cy - y * cx > zero) & (ex * y - cy * bx > zero);
  return z * z + (inside ? zero : edge2);
}

// --- the deciding test, in double ----------------------------------------------------------------

struct Vector {
  double x, y, z;
};
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector plus(Vector a, double t, Vector b) {
  return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vector toVector(const float* p) { return {p[0], p[1], p[2]}; }

inline void put(TreeHit& hit, double distance2, Vector point, int feature) {
  hit.distance2_mm2 = distance2;
  hit.point_mm[0] = point.x;
  hit.point_mm[1] = point.y;
  hit.point_mm[2] = point.z;
  hit.feature = feature;
}

/// Updates `hit` with the closest point on edge i, from corner a to corner b, if it is nearer.
inline void offerEdge(Vector p, Vector a, Vector b, int i, TreeHit& hit) {
  const Vector e = b - a;
  const double length2 = dot(e, e), s = dot(p - a, e);
  const bool at_a = !(s > 0), at_b = !at_a && s >= length2;
  const Vector point = at_a ? a : at_b ? b : plus(a, s / length2, e);
  const Vector away = p - point;
  const double distance2 = dot(away, away);
  if (!(distance2 < hit.distance2_mm2)) return;
  put(hit, distance2, point,
      at_a   ? kTreeVertex + i
      : at_b ? kTreeVertex + (i + 1) % 3
             : kTreeEdge + i);
}

/// Closest point on one triangle.
TreeHit closestOnTriangle(const TreeView& tree, std::int32_t triangle, Vector p) {
  const std::int32_t* corner = tree.triangles + 3L * triangle;
  const Vector v[3] = {toVector(tree.vertices_mm + 3L * corner[0]),
                       toVector(tree.vertices_mm + 3L * corner[1]),
                       toVector(tree.vertices_mm + 3L * corner[2])};
  const Vector n = cross(v[1] - v[0], v[2] - v[0]);
  bool inside = true;
  for (int i = 0; i < 3; ++i) inside = inside && dot(cross(v[(i + 1) % 3] - v[i], p - v[i]), n) > 0;

  TreeHit hit;
  hit.triangle = triangle;
  hit.height_mm = 0;
  if (inside) {
    const double n2 = dot(n, n), s = dot(p - v[0], n);
    hit.height_mm = s / std::sqrt(n2);
    put(hit, hit.height_mm * hit.height_mm, plus(p, -s / n2, n), kTreeFace);
    return hit;
  }
  hit.distance2_mm2 = HUGE_VAL;
  for (int i = 0; i < 3; ++i) offerEdge(p, v[i], v[(i + 1) % 3], i, hit);
  return hit;
}

// --- one point's search --------------------------------------------------------------------------

class Search {
 public:
  Search(const TreeView& tree, const float* point_mm)
      : tree_(tree),
        point_(toVector(point_mm)),
        lanes_{splat(point_mm[0]), splat(point_mm[1]), splat(point_mm[2])} {
    best_.triangle = -1;
    best_.distance2_mm2 = HUGE_VAL;
  }

  /// Upper bound of the distance from a point of the surface.
  void hint(const double* surface_point_mm) {
    const Vector away =
        point_ - Vector{surface_point_mm[0], surface_point_mm[1], surface_point_mm[2]};
    lowerCut(static_cast<float>(dot(away, away)));
  }

  TreeHit run() {
    push(0, tree_.leaf_count + tree_.node_count - 1, 0);
    while (depth_ > 0) {
      const std::uint64_t next = stack_[--depth_];
      if (distance2Of(next) > cut2_) continue;
      const std::int32_t slot = static_cast<std::int32_t>(next);
      slot < tree_.leaf_count ? visitLeaf(tree_.leaves[slot])
                              : visitNode(tree_.nodes[slot - tree_.leaf_count]);
    }
    decide();
    return best_;
  }

 private:
  // Eleven levels hold 2^33 leaves; each level leaves at most seven siblings on the stack.
  static constexpr int kStackSize = 96;
  static constexpr int kCandidateCount = 32;

  static float distance2Of(std::uint64_t entry) {
    const std::uint32_t pattern = static_cast<std::uint32_t>(entry >> 32);
    float distance2;
    std::memcpy(&distance2, &pattern, sizeof distance2);
    return distance2;
  }

  /// Keeps siblings from `first` on sorted, the closest on top. Squares
  /// are not negative, so their bit patterns have the same order.
  void push(float distance2, std::int32_t slot, int first) {
    std::uint32_t pattern;
    std::memcpy(&pattern, &distance2, sizeof pattern);
    const std::uint64_t entry =
        static_cast<std::uint64_t>(pattern) << 32 | static_cast<std::uint32_t>(slot);
    int place = depth_++;
    for (; place > first && stack_[place - 1] < entry; --place) stack_[place] = stack_[place - 1];
    stack_[place] = entry;
  }

  void visitNode(const TreeNode& node) {
    const Float8 distance2 = boxDistances2(node, lanes_);
    const int first = depth_;
    for (unsigned open = bits(distance2 <= splat(cut2_)); open != 0; open &= open - 1) {
      const int lane = __builtin_ctz(open);
      push(distance2[lane], node.first_child + lane, first);
    }
  }

  void visitLeaf(const TreeLeaf& leaf) {
    const Float8 distance2 = triangleDistances2(leaf, lanes_);
    if (bits(distance2 <= splat(cut2_)) == 0) return;
    lowerCut(smallestLane(distance2));
    for (unsigned open = bits(distance2 <= splat(cut2_)); open != 0; open &= open - 1) {
      const int lane = __builtin_ctz(open);
      if (candidate_count_ == kCandidateCount) decide();
      candidates_[candidate_count_++] = {distance2[lane], leaf.triangle[lane]};
    }
  }

  /// A triangle whose squared distance in float exceeds the cut cannot be as close as one found
  /// at `distance2` (in float): both have an error of up to the slack, hence the factor two.
  void lowerCut(float distance2) {
    const float cut = std::sqrt(distance2) * (1 + 2 * kTreeRelativeSlack) + 2 * tree_.slack_mm;
    const float cut2 = cut * cut;
    cut2_ = cut2 < cut2_ ? cut2 : cut2_;
  }

  void decide() {
    for (int i = 0; i < candidate_count_; ++i) {
      if (candidates_[i].distance2 > cut2_) continue;
      const TreeHit hit = closestOnTriangle(tree_, candidates_[i].triangle, point_);
      const bool tie = hit.distance2_mm2 == best_.distance2_mm2;
      if (hit.distance2_mm2 < best_.distance2_mm2 || (tie && hit.triangle < best_.triangle))
        best_ = hit;
    }
    candidate_count_ = 0;
  }

  struct Candidate {
    float distance2;
    std::int32_t triangle;
  };

  const TreeView& tree_;
  Vector point_;
  Point8 lanes_;
  float cut2_ = HUGE_VALF;
  int depth_ = 0;
  int candidate_count_ = 0;
  TreeHit best_;
  std::uint64_t stack_[kStackSize];
  Candidate candidates_[kCandidateCount];
};

void search(const TreeView& tree, const float* points_mm, const std::uint32_t* order, int begin,
            int end, TreeHit* hits) {
  const TreeHit* previous = nullptr;  // points are sorted along a curve: the result of a neighbour
  for (int i = begin; i < end; ++i) {
    Search one(tree, points_mm + 3L * order[i]);
    if (previous) one.hint(previous->point_mm);
    hits[order[i]] = one.run();
    previous = &hits[order[i]];
  }
}

}  // namespace

extern const TreeKernels SOFTSCOPE_NAME(treeKernels, SOFTSCOPE_SIMD_SET);
const TreeKernels SOFTSCOPE_NAME(treeKernels, SOFTSCOPE_SIMD_SET) = {
    SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET), search};

}  // namespace softscope
