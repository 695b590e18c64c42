#include "stereo/matching/delaunay.h"

// Divide and conquer after L. Guibas and J. Stolfi, "Primitives for the manipulation of general
// subdivisions and the computation of Voronoi diagrams", ACM Transactions on Graphics 4(2), 1985.
#include <algorithm>
#include <cstdint>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "stereo/matching/edge_rings.h"

namespace softscope {
namespace {

__extension__ typedef __int128 Int128;

/// Where coordinates differ by less than this, determinants stay below 12 * 2^56 and 12 * 2^120.
constexpr std::int64_t kExtent64 = std::int64_t{1} << 14, kExtent128 = std::int64_t{1} << 30;

constexpr int kSitesPerTask = 512;

/// The first axis of the algorithm is the image's y, so that points in raster order are sorted.
struct Site {
  int x, y;
};

/// Exact predicates on sites in raster order, given by their ranks.
template <class Wide>
class Predicates {
 public:
  explicit Predicates(std::vector<Site> sites) : sites_(std::move(sites)) {}

  /// Twice the signed area of a triangle; positive if counter-clockwise.
  Wide turn(int a, int b, int c) const {
    const Site &p = at(a), &q = at(b), &r = at(c);
    return difference(q.x, p.x) * difference(r.y, p.y) -
           difference(q.y, p.y) * difference(r.x, p.x);
  }

  /// Whether d lies inside the circle through a, b, c (counter-clockwise). On the circle, sites are
  /// lifted to the paraboloid and lowered by infinitesimal amounts, each far below that of the
  /// rank before: the first of the four decides.
  bool inCircle(int a, int b, int c, int d) const {
    const Wide inside = liftedVolume(a, b, c, d);
    if (inside != 0) return inside > 0;
    const int first = std::min({a, b, c, d});
    if (first == d) return true;
    // Lowering a corner lowers the circle's plane on the corner's side of the opposite edge alone.
    if (first == a) return turn(b, c, d) < 0;
    if (first == b) return turn(c, a, d) < 0;
    return turn(a, b, d) < 0;
  }

 private:
  const Site& at(int rank) const { return sites_[static_cast<std::size_t>(rank)]; }
  static Wide difference(int p, int q) { return static_cast<Wide>(p) - q; }

  Wide liftedVolume(int a, int b, int c, int d) const {
    const Site& o = at(d);
    const Wide ax = difference(at(a).x, o.x), ay = difference(at(a).y, o.y);
    const Wide bx = difference(at(b).x, o.x), by = difference(at(b).y, o.y);
    const Wide cx = difference(at(c).x, o.x), cy = difference(at(c).y, o.y);
    return (ax * ax + ay * ay) * (bx * cy - by * cx) + (bx * bx + by * by) * (cx * ay - cy * ax) +
           (cx * cx + cy * cy) * (ax * by - ay * bx);
  }

  std::vector<Site> sites_;
};

template <class Wide>
class Triangulation {
 public:
  explicit Triangulation(std::vector<Site> sites)
      : count_(static_cast<int>(sites.size())),
        rings_(sites.size()),
        predicates_(std::move(sites)) {
    if (count_ > 1) first_ = triangulate(0, count_).hull.of_first;
  }

  /// Ranks of the corners; the smallest first.
  std::vector<std::array<int, 3>> triangles() const {
    std::vector<std::array<int, 3>> found;
    found.reserve(2 * static_cast<std::size_t>(count_));
    if (count_ < 3) return found;
    for (const int start : startOfEachRing()) {
      const int site = rings_.origin(start);
      int edge = start;
      do {
        const int next = rings_.next(edge);
        const int b = rings_.destination(edge), c = rings_.destination(next);
        if (b > site && c > site && predicates_.turn(site, b, c) > 0) found.push_back({site, b, c});
        edge = next;
      } while (edge != start);
    }
    return found;
  }

 private:
  /// Edges of the convex hull out of the first and the last site of a part: counter-clockwise and
  /// clockwise along the hull.
  struct Hull {
    int of_first, of_last;
  };

  /// A triangulated part, and the edges that it left over.
  struct Part {
    Hull hull;
    EdgeRings::Pool pool;
  };

  bool isLeft(int site, int edge) const {
    return predicates_.turn(rings_.origin(edge), rings_.destination(edge), site) > 0;
  }
  bool isRight(int site, int edge) const {
    return predicates_.turn(rings_.origin(edge), rings_.destination(edge), site) < 0;
  }

  /// Large parts on all cores. Which edges a part takes does not matter to its triangles.
  Part triangulate(int begin, int end) {
    if (end - begin <= kSitesPerTask) {
      EdgeRings::Pool pool = rings_.poolOf(begin, end);
      const Hull hull = triangulate(begin, end, &pool);
      return {hull, pool};
    }
    const int middle = begin + (end - begin) / 2;
    Part left, right;
    parallelInvoke([&] { left = triangulate(begin, middle); },
                   [&] { right = triangulate(middle, end); });
    EdgeRings::Pool pool = rings_.join(left.pool, right.pool);
    const Hull hull = merge(left.hull, right.hull, &pool);
    return {hull, pool};
  }

  Hull triangulate(int begin, int end, EdgeRings::Pool* pool) {
    if (end - begin == 2) return joinTwo(begin, pool);
    if (end - begin == 3) return joinThree(begin, pool);
    const int middle = begin + (end - begin) / 2;
    const Hull left = triangulate(begin, middle, pool);
    return merge(left, triangulate(middle, end, pool), pool);
  }

  Hull joinTwo(int first, EdgeRings::Pool* pool) {
    const int edge = rings_.make(first, first + 1, pool);
    return {edge, EdgeRings::twin(edge)};
  }

  Hull joinThree(int first, EdgeRings::Pool* pool) {
    const int a = rings_.make(first, first + 1, pool), b = rings_.make(first + 1, first + 2, pool);
    rings_.insertAfter(EdgeRings::twin(a), b);
    const Wide turn = predicates_.turn(first, first + 1, first + 2);
    if (turn == 0) return {a, EdgeRings::twin(b)};
    const int c = rings_.connect(b, a, pool);
    if (turn > 0) return {a, EdgeRings::twin(b)};
    return {EdgeRings::twin(c), c};
  }

  /// The common tangent below both parts, from right to left.
  int joinBelow(int left, int right, EdgeRings::Pool* pool) {
    for (;;) {
      if (isLeft(rings_.origin(right), left))
        left = rings_.nextOfFace(left);
      else if (isRight(rings_.origin(left), right))
        right = rings_.next(EdgeRings::twin(right));
      else
        return rings_.connect(EdgeRings::twin(right), left, pool);
    }
  }

  Hull merge(Hull left, Hull right, EdgeRings::Pool* pool) {
    int base = joinBelow(left.of_last, right.of_first, pool);
    Hull hull = {left.of_first, right.of_last};
    if (rings_.destination(base) == rings_.origin(hull.of_first))
      hull.of_first = EdgeRings::twin(base);
    if (rings_.origin(base) == rings_.origin(hull.of_last)) hull.of_last = base;
    for (;;) {
      const int in_left = leftCandidate(base, pool), in_right = rightCandidate(base, pool);
      const bool left_fits = isRight(rings_.destination(in_left), base);
      const bool right_fits = isRight(rings_.destination(in_right), base);
      if (!left_fits && !right_fits) return hull;
      const bool take_right =
          !left_fits || (right_fits && predicates_.inCircle(
                                           rings_.destination(in_left), rings_.origin(in_left),
                                           rings_.origin(in_right), rings_.destination(in_right)));
      base = take_right ? rings_.connect(in_right, EdgeRings::twin(base), pool)
                        : rings_.connect(EdgeRings::twin(base), EdgeRings::twin(in_left), pool);
    }
  }

  /// The first edge of the left part above `base` whose circle with it contains no further site of
  /// that part. Removes the edges before it.
  int leftCandidate(int base, EdgeRings::Pool* pool) {
    int edge = rings_.next(EdgeRings::twin(base));
    while (isRight(rings_.destination(edge), base)) {
      const int behind = rings_.next(edge);
      if (behind == EdgeRings::twin(base) || !fails(edge, behind, base)) break;
      rings_.remove(edge, pool);
      edge = behind;
    }
    return edge;
  }

  int rightCandidate(int base, EdgeRings::Pool* pool) {
    int edge = rings_.previous(base);
    while (isRight(rings_.destination(edge), base)) {
      const int behind = rings_.previous(edge);
      if (behind == base || !fails(edge, behind, base)) break;
      rings_.remove(edge, pool);
      edge = behind;
    }
    return edge;
  }

  /// Whether the circle through `base` and the end of `edge` contains the end of `behind`.
  bool fails(int edge, int behind, int base) const {
    return predicates_.inCircle(rings_.destination(base), rings_.origin(base),
                                rings_.destination(edge), rings_.destination(behind));
  }

  /// Of each site an edge from which counter-clockwise those to later sites come in one run.
  std::vector<int> startOfEachRing() const {
    std::vector<int> starts(static_cast<std::size_t>(count_));
    for (int edge = 0; edge < rings_.end(); ++edge) {
      const int site = rings_.origin(edge);
      if (site > rings_.destination(edge)) starts[static_cast<std::size_t>(site)] = edge;
    }
    starts[0] = first_;
    return starts;
  }

  int count_;
  EdgeRings rings_;
  Predicates<Wide> predicates_;
  int first_ = -1;  // the hull's edge out of the first site
};

bool before(const Eigen::Vector2i& p, const Eigen::Vector2i& q) {
  return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
}

/// Indices of distinct points, in raster order.
std::vector<int> rasterOrder(const std::vector<Eigen::Vector2i>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto point = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  if (!std::is_sorted(points.begin(), points.end(), before))
    std::stable_sort(order.begin(), order.end(),
                     [&](int i, int j) { return before(point(i), point(j)); });
  order.erase(
      std::unique(order.begin(), order.end(), [&](int i, int j) { return point(i) == point(j); }),
      order.end());
  return order;
}

/// The larger of width and height.
std::int64_t extentOf(const std::vector<Site>& sites) {
  const auto [left, right] = std::minmax_element(
      sites.begin(), sites.end(), [](const Site& p, const Site& q) { return p.y < q.y; });
  return std::max(std::int64_t{right->y} - left->y, std::int64_t{sites.back().x} - sites.front().x);
}

}  // namespace

std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2i>& points) {
  const std::vector<int> order = rasterOrder(points);
  if (order.size() < 3) return {};
  std::vector<Site> sites;
  sites.reserve(order.size());
  for (const int i : order) {
    const Eigen::Vector2i& p = points[static_cast<std::size_t>(i)];
    sites.push_back({p.y(), p.x()});
  }
  const std::int64_t extent = extentOf(sites);
  if (extent >= kExtent128)
    throw Error("points to triangulate are " + std::to_string(extent) +
                " apart, but must be less than 2^30");
  auto triangles = extent < kExtent64 ? Triangulation<std::int64_t>(std::move(sites)).triangles()
                                      : Triangulation<Int128>(std::move(sites)).triangles();
  for (auto& triangle : triangles)
    for (int& corner : triangle) corner = order[static_cast<std::size_t>(corner)];
  return triangles;
}

}  // namespace softscope
