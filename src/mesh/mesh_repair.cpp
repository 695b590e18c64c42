// src/mesh/mesh_repair.cpp: sequence of repairs that do not undo each other.
#include "mesh/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "mesh/hole_closing.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_sides.h"
#include "mesh/triangle_turning.h"
#include "mesh/union_find.h"

namespace softscope {
namespace {

constexpr double kWidestHole = 1.0 / 3;  // of the box of the mesh; wider ones may be intended

template <class... Parts>
std::string say(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

class Repair {
 public:
  Repair(TriangleMesh mesh, const std::string& name) : mesh_(std::move(mesh)), name_(name) {}

  RepairedMesh run() {
    joinOpenEdges();
    dropTriangles();
    refuseCrowdedEdges();
    turnTriangles();
    partSheets();
    closeItsHoles();
    turnOutward();
    dropVertices();
    return {std::move(mesh_), std::move(repairs_)};
  }

 private:
  template <class... Parts>
  void record(bool holds, const Parts&... parts) {
    if (holds) repairs_.push_back(say(parts...));
  }

  /// Merges vertices of open edges at the same position.
  void joinOpenEdges() {
    std::set<std::int32_t> open;
    forEachEdge(sortedSides(mesh_), [&](auto first, auto last) {
      if (last - first == 1) open.insert({first->low, first->high});
    });
    std::map<std::array<float, 3>, std::int32_t> at_place;
    std::map<std::int32_t, std::int32_t> joined;
    for (const std::int32_t vertex : open) {
      const Eigen::Vector3f& p = mesh_.vertices_mm[vertex];
      const auto [place, is_new] = at_place.try_emplace({p.x(), p.y(), p.z()}, vertex);
      if (!is_new) joined[vertex] = place->second;
    }
    for (Triangle& t : mesh_.triangles)
      for (std::int32_t& corner : t)
        if (const auto found = joined.find(corner); found != joined.end()) corner = found->second;
    record(!joined.empty(), "joined ", joined.size(), " doubled vertices along open edges");
  }

  void dropTriangles() {
    std::set<Triangle> known;
    std::size_t folded = 0, doubled = 0;
    std::vector<Triangle> kept;
    for (const Triangle& t : mesh_.triangles) {
      Triangle sorted = t;
      std::sort(sorted.begin(), sorted.end());
      if (isFolded(t))
        ++folded;
      else if (!known.insert(sorted).second)
        ++doubled;
      else
        kept.push_back(t);
    }
    mesh_.triangles = std::move(kept);
    record(folded > 0, "dropped ", folded, " triangles that name a vertex twice");
    record(doubled > 0, "dropped ", doubled, " triangles that were there already");
    if (mesh_.triangles.empty()) throw InputError(name_ + ": no triangle of the mesh has an area");
  }

  void refuseCrowdedEdges() const {
    std::size_t crowded = 0;
    Eigen::Vector3f place_mm;
    forEachEdge(sortedSides(mesh_), [&](auto first, auto last) {
      if (last - first > 2 && crowded++ == 0)
        place_mm = 0.5F * (mesh_.vertices_mm[first->low] + mesh_.vertices_mm[first->high]);
    });
    if (crowded > 0)
      throw InputError(say(name_, ": ", crowded,
                           " edges belong to more than two triangles, the first near (",
                           place_mm.transpose(),
                           ") mm, but tissue has one inside and one outside; delete the walls "
                           "inside the mesh, or export its outer surface alone"));
  }

  void turnTriangles() {
    const TurnedTriangles turned = orientConsistently(mesh_);
    if (turned.one_sided)
      throw InputError(name_ +
                       ": the surface has one side only, like a Moebius strip, but tissue has an "
                       "inside and an outside; mend the faces where it is twisted");
    record(turned.count > 0, "turned ", turned.count,
           " triangles that faced against their neighbours");
  }

  /// One vertex per sheet of edge-connected triangles.
  void partSheets() {
    UnionFind corners(3 * mesh_.triangles.size());
    const auto cornerOf = [&](const MeshSide& side, std::int32_t vertex) {
      const Triangle& t = mesh_.triangles[side.triangle];
      return 3 * side.triangle +
             static_cast<std::int32_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
    };
    forEachEdge(sortedSides(mesh_), [&](auto first, auto last) {
      for (auto side = first; side != last; ++side)
        for (const std::int32_t vertex : {first->low, first->high})
          corners.join(cornerOf(*side, vertex), cornerOf(*first, vertex));
    });
    std::map<std::int32_t, std::int32_t> vertex_of;  // by the sheet of a corner at a vertex
    std::vector<bool> taken(mesh_.vertices_mm.size(), false);
    const std::size_t before = mesh_.vertices_mm.size();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        std::int32_t& vertex = mesh_.triangles[i][k];
        const std::int32_t sheet = corners.find(static_cast<std::int32_t>(3 * i) + k);
        const auto [known, is_new] = vertex_of.try_emplace(sheet, vertex);
        if (is_new && taken[vertex]) known->second = copyOf(vertex);
        if (is_new && std::size_t(vertex) < before) taken[vertex] = true;
        vertex = known->second;
      }
    record(mesh_.vertices_mm.size() > before, "parted sheets that touched in ",
           mesh_.vertices_mm.size() - before, " points");
  }

  std::int32_t copyOf(std::int32_t vertex) {
    mesh_.vertices_mm.push_back(Eigen::Vector3f(mesh_.vertices_mm[vertex]));
    if (!mesh_.colours.empty()) mesh_.colours.push_back(Rgb8(mesh_.colours[vertex]));
    return static_cast<std::int32_t>(mesh_.vertices_mm.size()) - 1;
  }

  void closeItsHoles() {
    const MeshCheck check = checkMesh(mesh_);
    if (check.border_edges == 0) return;
    const ClosedHoles holes = closeHoles(mesh_, kWidestHole * check.size_mm().norm());
    record(holes.closed > 0, "closed ", holes.closed, " holes of ", holes.edges,
           " edges, the widest ", holes.widest_mm, " mm");
    record(holes.left_open > 0, "left ", holes.left_open,
           " holes open that are wider than a third of the mesh");
  }

  void turnOutward() {
    if (!(checkMesh(mesh_).volume_mm3 < 0)) return;  // NaN for an open mesh
    for (Triangle& t : mesh_.triangles) std::swap(t[1], t[2]);
    record(true, "turned the surface, which was inside out");
  }

  void dropVertices() {
    std::vector<std::int32_t> number(mesh_.vertices_mm.size(), -1);
    for (const Triangle& t : mesh_.triangles)
      for (const std::int32_t vertex : t) number[vertex] = 0;
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (number[i] < 0) continue;
      mesh_.vertices_mm[kept] = mesh_.vertices_mm[i];
      if (!mesh_.colours.empty()) mesh_.colours[kept] = mesh_.colours[i];
      number[i] = kept++;
    }
    record(std::size_t(kept) < number.size(), "dropped ", number.size() - kept,
           " vertices that no triangle names");
    mesh_.vertices_mm.resize(kept);
    if (!mesh_.colours.empty()) mesh_.colours.resize(kept);
    for (Triangle& t : mesh_.triangles)
      for (std::int32_t& vertex : t) vertex = number[vertex];
  }

  TriangleMesh mesh_;
  const std::string& name_;
  std::vector<std::string> repairs_;
};

}  // namespace

RepairedMesh repairMesh(TriangleMesh mesh, const std::string& name) {
  return Repair(std::move(mesh), name).run();
}

}  // namespace softscope
