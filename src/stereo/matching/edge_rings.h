// src/stereo/matching/edge_rings.h: the edges of a planar graph, in order around each vertex.
#pragma once

#include <vector>

namespace softscope {

/// Directed edges in pairs: edge e and its twin e ^ 1 run between the same vertices. The edges out
/// of a vertex form a ring, counter-clockwise (the quad-edge of Guibas and Stolfi, 1985, without
/// the dual graph).
class EdgeRings {
 public:
  /// Edges that are not in use. Parts of the graph that are built at the same time have pools of
  /// their own.
  struct Pool {
    int first = -1, last = -1;  // the `next` of a free edge is the one behind it; -1: none
  };

  /// A planar graph has less than three edges per vertex.
  explicit EdgeRings(std::size_t vertices) : edges_(6 * vertices) {}

  /// Enough for a graph of the vertices from `begin` to, not with, `end`. No two pools may overlap.
  Pool poolOf(int begin, int end) {
    for (int edge = 6 * begin; edge < 6 * end; edge += 2)
      at(edge).next = edge + 2 < 6 * end ? edge + 2 : -1;
    return {6 * begin, 6 * end - 2};
  }
  Pool join(const Pool& a, const Pool& b) {
    if (a.first < 0) return b;
    if (b.first >= 0) at(a.last).next = b.first;
    return {a.first, b.first < 0 ? a.last : b.last};
  }

  static int twin(int edge) { return edge ^ 1; }
  int origin(int edge) const { return at(edge).origin; }
  int destination(int edge) const { return at(twin(edge)).origin; }
  /// Around the origin, counter-clockwise and clockwise.
  int next(int edge) const { return at(edge).next; }
  int previous(int edge) const { return at(edge).previous; }
  /// Around the face on the edge's left.
  int nextOfFace(int edge) const { return previous(twin(edge)); }

  /// One past the largest edge; free edges among them have no origin (-1).
  int end() const { return static_cast<int>(edges_.size()); }

  /// An edge that is alone in its two rings.
  int make(int origin, int destination, Pool* pool) {
    const int edge = pool->first;
    pool->first = at(edge).next;
    at(edge) = {origin, edge, edge};
    at(twin(edge)) = {destination, twin(edge), twin(edge)};
    return edge;
  }

  /// Puts `edge`, alone in its ring, behind `place` in the ring of `place`.
  void insertAfter(int place, int edge) {
    const int behind = next(place);
    at(edge).previous = place;
    at(edge).next = behind;
    at(place).next = edge;
    at(behind).previous = edge;
  }

  /// A new edge from the destination of `from` to the origin of `to`; all three have the same face
  /// on their left.
  int connect(int from, int to, Pool* pool) {
    const int edge = make(destination(from), origin(to), pool);
    insertAfter(nextOfFace(from), edge);
    insertAfter(to, twin(edge));
    return edge;
  }

  void remove(int edge, Pool* pool) {
    takeOut(edge);
    takeOut(twin(edge));
    edge &= ~1;
    at(edge).next = pool->first;
    if (pool->first < 0) pool->last = edge;
    pool->first = edge;
  }

 private:
  struct Edge {
    int origin = -1, next = -1, previous = -1;
  };

  Edge& at(int edge) { return edges_[static_cast<std::size_t>(edge)]; }
  const Edge& at(int edge) const { return edges_[static_cast<std::size_t>(edge)]; }

  void takeOut(int edge) {
    at(previous(edge)).next = next(edge);
    at(next(edge)).previous = previous(edge);
    at(edge).origin = -1;
  }

  std::vector<Edge> edges_;
};

}  // namespace softscope
