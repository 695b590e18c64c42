// src/mesh/mesh_check.cpp: edges by sorting, pieces and sheets by union-find.
#include "mesh/mesh_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mesh/union_find.h"

namespace softscope {
namespace {

constexpr double kFlat = 1e-6;  // height over longest side: what float coordinates can't tell

/// An organ or what a scope sees of it is 5 mm to 2 m long; other numbers are other units.
constexpr double kShortestOrgan_mm = 5, kLongestOrgan_mm = 2000;

bool folded(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Side k of a triangle: from corner k to the next.
struct Side {
  std::int32_t low, high;  // vertices
  std::int32_t triangle;
  std::int8_t k;
  bool ascending;  // runs from low to high
};

/// Sorted, so that sides of one edge follow each other.
std::vector<Side> sortedSides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (folded(t)) continue;
    for (std::int8_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(i), k, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  return sides;
}

/// The corner of a side's triangle that names `vertex`, one of the side's two.
std::int32_t cornerAt(const Side& side, std::int32_t vertex) {
  const bool first = side.ascending == (vertex == side.low);
  return 3 * side.triangle + (first ? side.k : (side.k + 1) % 3);
}

/// Counts edges by kind and joins the corners of neighbours.
void countEdges(const std::vector<Side>& sides, MeshCheck& check, UnionFind& sheets) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const Side& first = sides[begin];
    int ascending = 0;
    for (; end < sides.size() && sides[end].low == first.low && sides[end].high == first.high;
         ++end) {
      ascending += sides[end].ascending;
      sheets.join(cornerAt(sides[end], first.low), cornerAt(first, first.low));
      sheets.join(cornerAt(sides[end], first.high), cornerAt(first, first.high));
    }
    const std::size_t count = end - begin;
    check.border_edges += count == 1;
    check.crowded_edges += count > 2;
    check.flipped_edges += count == 2 && ascending != 1;
  }
}

/// Vertices whose corners are not all joined through edges.
std::size_t countSplitVertices(const TriangleMesh& mesh, UnionFind& sheets) {
  constexpr std::int32_t kNone = -1, kSplit = -2;
  std::vector<std::int32_t> sheet(mesh.vertices_mm.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (folded(mesh.triangles[i])) continue;
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
  std::vector<char> used(mesh.vertices_mm.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t vertex : t) {
      pieces.join(vertex, t[0]);
      used[vertex] = 1;
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
  const Eigen::Vector3d centre = box.center().cast<double>();  // keeps the volume's terms small
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
  UnionFind sheets(3 * mesh.triangles.size());
  countEdges(sortedSides(mesh), check, sheets);
  check.split_vertices = countSplitVertices(mesh, sheets);
  countPieces(mesh, check);
  measure(mesh, check);
  if (!check.closed() || !check.oriented() || check.crowded_edges > 0)
    check.volume_mm3 = std::numeric_limits<double>::quiet_NaN();
  check.likely_unit_mm = likelyUnit(check.size_mm().maxCoeff());
  return check;
}

std::vector<std::string> meshWarnings(const MeshCheck& check) {
  std::vector<std::string> lines;
  const auto warn = [&](bool holds, auto... parts) {
    if (!holds) return;
    std::ostringstream line;
    (line << ... << parts);
    lines.push_back(line.str());
  };
  const float longest = check.size_mm().maxCoeff();
  warn(check.likely_unit_mm == 1000, "the box is ", longest,
       " mm long; in metres? Then say so (unit 1000 mm)");
  warn(check.likely_unit_mm == 0.001, "the box is ", longest,
       " mm long; in micrometres? Then say so (unit 0.001 mm)");
  warn(check.border_edges > 0, check.border_edges,
       " open edges: no inside and no volume; signed distances are unknown at the border");
  warn(check.crowded_edges > 0, check.crowded_edges, " edges of more than two triangles");
  warn(check.flipped_edges > 0, check.flipped_edges,
       " edges whose two triangles face opposite ways: signs are unreliable there");
  warn(check.split_vertices > 0, check.split_vertices, " vertices where sheets touch in one point");
  warn(check.degenerate_triangles > 0, check.degenerate_triangles, " triangles without area");
  warn(check.unused_vertices > 0, check.unused_vertices, " vertices that no triangle names");
  warn(check.volume_mm3 < 0, "the surface is inside out: signs of distances are reversed");
  return lines;
}

}  // namespace softscope
