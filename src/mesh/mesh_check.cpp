// src/mesh/mesh_check.cpp: edges by sorting, components and sheets by union-find.
#include "mesh/mesh_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mesh/mesh_sides.h"
#include "mesh/union_find.h"

namespace softscope {
namespace {

constexpr double kFlat = 1e-6;  // height over longest side: float resolution

/// An organ or its visible part is 5 mm to 2 m long; other sizes indicate other units.
constexpr double kShortestOrgan_mm = 5, kLongestOrgan_mm = 2000;

/// Corner of the triangle of a side at `vertex`, one of its two vertices.
std::int32_t cornerAt(const MeshSide& side, std::int32_t vertex) {
  const bool first = side.ascending == (vertex == side.low);
  return 3 * side.triangle + (first ? side.k : (side.k + 1) % 3);
}

/// Counts edges by kind and joins the corners of neighbours.
void countEdges(const std::vector<MeshSide>& sides, MeshCheck& check, UnionFind& sheets) {
  forEachEdge(sides, [&](auto first, auto last) {
    int ascending = 0;
    for (auto side = first; side != last; ++side) {
      ascending += side->ascending;
      sheets.join(cornerAt(*side, first->low), cornerAt(*first, first->low));
      sheets.join(cornerAt(*side, first->high), cornerAt(*first, first->high));
    }
    const auto count = last - first;
    check.border_edges += count == 1;
    check.crowded_edges += count > 2;
    check.flipped_edges += count == 2 && ascending != 1;
  });
}

/// Number of vertices whose corners are not all joined through edges.
std::size_t countSplitVertices(const TriangleMesh& mesh, UnionFind& sheets) {
  constexpr std::int32_t kNone = -1, kSplit = -2;
  std::vector<std::int32_t> sheet(mesh.vertices_mm.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (isFolded(mesh.triangles[i])) continue;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& at_vertex = sheet[mesh.triangles[i][k]];
      const std::int32_t found = sheets.find(static_cast<std::int32_t>(3 * i) + k);
      if (at_vertex == kNone) at_vertex = found;
      if (at_vertex != found) at_vertex = kSplit;
    }
  }
  return static_cast<std::size_t>(std::count(sheet.begin(), sheet.end(), kSplit));
}

void countPieces(const TriangleMesh& mesh, MeshCheck& check) {
  UnionFind pieces(mesh.vertices_mm.size());
  std::vector<bool> used(mesh.vertices_mm.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t vertex : t) {
      pieces.join(vertex, t[0]);
      used[vertex] = true;
    }
  for (std::size_t v = 0; v < used.size(); ++v) {
    check.unused_vertices += !used[v];
    check.components +=
        used[v] && pieces.find(static_cast<std::int32_t>(v)) == static_cast<std::int32_t>(v);
  }
}

void measure(const TriangleMesh& mesh, MeshCheck& check) {
  if (mesh.triangles.empty()) return;
  Eigen::AlignedBox3f box;
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t vertex : t) box.extend(mesh.vertices_mm[vertex]);
  check.low_mm = box.min();
  check.high_mm = box.max();
  const Eigen::Vector3d centre = box.center().cast<double>();  // reduces rounding of the volume
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[t[0]].cast<double>() - centre;
    const Eigen::Vector3d b = mesh.vertices_mm[t[1]].cast<double>() - centre;
    const Eigen::Vector3d c = mesh.vertices_mm[t[2]].cast<double>() - centre;
    const double double_area = (b - a).cross(c - a).norm();
    const double longest2 =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    check.area_mm2 += double_area / 2;
    check.volume_mm3 += a.dot(b.cross(c)) / 6;
    check.degenerate_triangles += double_area <= kFlat * longest2;
  }
}

double likelyUnit(double longest_side) {
  const auto like_an_organ = [](double side_mm) {
    return side_mm >= kShortestOrgan_mm && side_mm <= kLongestOrgan_mm;
  };
  for (const double unit_mm : {1.0, 1000.0, 0.001})
    if (like_an_organ(longest_side * unit_mm)) return unit_mm;
  return 1;
}

}  // namespace

MeshCheck checkMesh(const TriangleMesh& mesh) {
  MeshCheck check;
  check.vertex_count = mesh.vertices_mm.size();
  check.triangle_count = mesh.triangles.size();
  const std::vector<MeshSide> sides = sortedSides(mesh);
  UnionFind sheets(3 * mesh.triangles.size());
  countEdges(sides, check, sheets);
  check.split_vertices = countSplitVertices(mesh, sheets);
  countPieces(mesh, check);
  measure(mesh, check);
  if (!check.closed() || !check.oriented() || check.crowded_edges > 0)
    check.volume_mm3 = std::numeric_limits<double>::quiet_NaN();
  check.likely_unit_mm = likelyUnit(check.size_mm().maxCoeff());
  return check;
}

std::vector<std::string> meshWarnings(const MeshCheck& check, const std::string& unit_option) {
  std::vector<std::string> lines;
  const auto warn = [&](bool holds, auto... parts) {
    if (!holds) return;
    std::ostringstream line;
    (line << ... << parts);
    lines.push_back(line.str());
  };
  const float longest = check.size_mm().maxCoeff();
  warn(check.likely_unit_mm == 1000, "the box is ", longest,
       " mm long; in metres? Then give 1000 as ", unit_option);
  warn(check.likely_unit_mm == 0.001, "the box is ", longest,
       " mm long; in micrometres? Then give 0.001 as ", unit_option);
  warn(check.border_edges > 0, check.border_edges,
       " open edges: no inside and no volume; signed distances are unknown at the border");
  warn(check.crowded_edges > 0, check.crowded_edges, " edges of more than two triangles");
  warn(check.flipped_edges > 0, check.flipped_edges,
       " edges whose two triangles face opposite ways: signs are unreliable there");
  warn(check.split_vertices > 0, check.split_vertices, " vertices where sheets touch in one point");
  warn(check.degenerate_triangles > 0, check.degenerate_triangles, " triangles without area");
  warn(check.unused_vertices > 0, check.unused_vertices, " vertices that no triangle names");
  warn(check.volume_mm3 < 0,
       "the surface is inside out: as a reference, it reverses the signs of distances");
  return lines;
}

}  // namespace softscope
