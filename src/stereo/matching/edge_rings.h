// src/stereo/matching/edge_rings.h: the edges of a planar graph, in order around each vertex.
#pragma once

#include <vector>

namespace softscope {

/// Directed edges in pairs: edge e and its twin e ^ 1 run between the same vertices. The edges out
/// of a vertex form a ring, counter-clockwise (the quad-edge of Guibas and Stolfi, 1985, without
/// the dual graph).
class EdgeRings {
 public:
  explicit EdgeRings(std::size_t vertices) { edges_.reserve(6 * vertices); }

  static int twin(int edge) { return edge ^ 1; }
  int origin(int edge) const { return at(edge).origin; }
  int destination(int edge) const { return at(twin(edge)).origin; }
  /// Around the origin, counter-clockwise and clockwise.
  int next(int edge) const { return at(edge).next; }
  int previous(int edge) const { return at(edge).previous; }
  /// Around the face on the edge's left.
  int nextOfFace(int edge) const { return previous(twin(edge)); }

  /// One past the largest edge; removed edges among them have no origin (-1).
  int end() const { return static_cast<int>(edges_.size()); }

  /// An edge that is alone in its two rings.
  int make(int origin, int destination) {
    int edge = free_;
    if (edge < 0) {
      edge = end();
      edges_.resize(edges_.size() + 2);
    } else {
      free_ = at(edge).next;
    }
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
  int connect(int from, int to) {
    const int edge = make(destination(from), origin(to));
    insertAfter(nextOfFace(from), edge);
    insertAfter(to, twin(edge));
    return edge;
  }

  void remove(int edge) {
    takeOut(edge);
    takeOut(twin(edge));
    edge &= ~1;
    at(edge).next = free_;
    free_ = edge;
  }

 private:
  struct Edge {
    int origin, next, previous;
  };

  Edge& at(int edge) { return edges_[static_cast<std::size_t>(edge)]; }
  const Edge& at(int edge) const { return edges_[static_cast<std::size_t>(edge)]; }

  void takeOut(int edge) {
    at(previous(edge)).next = next(edge);
    at(next(edge)).previous = previous(edge);
    at(edge).origin = -1;
  }

  std::vector<Edge> edges_;
  int free_ = -1;  // the last removed edge, whose `next` is the one removed before it
};

}  // namespace softscope
