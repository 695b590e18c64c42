// eval/simulation/wound/splitting_mesh.cpp: index of triangles by directed edges.
#include "eval/simulation/wound/splitting_mesh.h"

#include <sstream>

#include "core/error.h"

namespace softscope {
namespace {

constexpr std::int32_t kSeveral = -1;

/// Both are on one triangle of the organ, so three of its vertices are sufficient.
OrganPlace between(const OrganPlace& a, const OrganPlace& b, float share) {
  OrganPlace place{a.vertices, (1 - share) * a.shares};
  for (int k = 0; k < 3; ++k) {
    if (b.shares[k] == 0) continue;
    int slot = 0;
    while (slot < 3 && !(place.vertices[slot] == b.vertices[k] && a.shares[slot] > 0)) ++slot;
    if (slot == 3)
      for (slot = 0; slot < 2 && place.shares[slot] > 0;) ++slot;
    place.vertices[slot] = b.vertices[k];
    place.shares[slot] += share * b.shares[k];
  }
  return place;
}

}  // namespace

SplittingMesh::SplittingMesh(const TriangleMesh& organ)
    : vertices_mm_(organ.vertices_mm), triangles_(organ.triangles) {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(vertices_mm_.size()); ++i)
    places_.push_back({{i, i, i}, Eigen::Vector3f::UnitX()});
  triangle_at_.reserve(3 * triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (int side = 0; side < 3; ++side) {
      const std::int32_t a = triangles_[i][side], b = triangles_[i][(side + 1) % 3];
      if (a < 0 || std::size_t(a) >= vertices_mm_.size())
        throw InputError("the surface names a vertex that isn't there; repair the mesh");
      const auto [place, is_new] =
          triangle_at_.try_emplace(keyOf(a, b), static_cast<std::int32_t>(i));
      if (!is_new) place->second = kSeveral;
    }
}

std::int32_t SplittingMesh::triangleAt(std::int32_t a, std::int32_t b) const {
  const auto found = triangle_at_.find(keyOf(a, b));
  if (found != triangle_at_.end() && found->second != kSeveral) return found->second;
  std::ostringstream text;
  text << "the cut meets an edge near (" << vertices_mm_[a].transpose() << ") mm that "
       << (found == triangle_at_.end() ? "is open" : "belongs to more than two triangles")
       << ", but it takes closed tissue; move it by cut.x_mm and cut.y_mm, or repair the mesh";
  throw InputError(text.str());
}

std::int32_t SplittingMesh::cornerOpposite(std::int32_t a, std::int32_t b) const {
  const Triangle& t = triangles_[triangleAt(a, b)];
  for (int k = 0; k < 3; ++k)
    if (t[k] == a && t[(k + 1) % 3] == b) return t[(k + 2) % 3];
  return t[0];
}

/// (a, b, c) becomes (a, middle, c) and the new triangle (middle, b, c).
void SplittingMesh::halve(std::int32_t a, std::int32_t b, std::int32_t middle) {
  const std::int32_t old = triangleAt(a, b), c = cornerOpposite(a, b);
  const auto added = static_cast<std::int32_t>(triangles_.size());
  triangles_[old] = {a, middle, c};
  triangles_.push_back({middle, b, c});
  triangle_at_.erase(keyOf(a, b));
  for (const auto& [from, to, triangle] :
       {std::array{a, middle, old}, std::array{middle, c, old}, std::array{middle, b, added},
        std::array{b, c, added}, std::array{c, middle, added}})
    triangle_at_[keyOf(from, to)] = triangle;
}

std::int32_t SplittingMesh::split(std::int32_t a, std::int32_t b, double share) {
  triangleAt(a, b);  // both triangles or none
  triangleAt(b, a);
  const auto middle = static_cast<std::int32_t>(vertices_mm_.size());
  const auto t = static_cast<float>(share);
  vertices_mm_.push_back(vertices_mm_[a] + t * (vertices_mm_[b] - vertices_mm_[a]));
  places_.push_back(between(places_[a], places_[b], t));
  halve(a, b, middle);
  halve(b, a, middle);
  return middle;
}

}  // namespace softscope
