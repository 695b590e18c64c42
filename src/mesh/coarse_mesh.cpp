// src/mesh/coarse_mesh.cpp: vertex clustering with original vertices as representatives.
#include "mesh/coarse_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.h"

namespace softscope {
namespace {

/// Group of each vertex, numbered in the order of the cells.
struct Groups {
  std::vector<std::int32_t> of_vertex;
  std::size_t count = 0;
};

/// `low_mm`: corner of the box. At most 2^20 cells per axis.
Groups groupByCell(const std::vector<Eigen::Vector3f>& vertices_mm, const Eigen::Vector3d& low_mm,
                   double cell_mm) {
  std::vector<std::uint64_t> cells;
  cells.reserve(vertices_mm.size());
  for (const Eigen::Vector3f& p : vertices_mm) {
    std::uint64_t cell = 0;
    for (int k = 0; k < 3; ++k) {
      const double place = std::floor((double(p[k]) - low_mm[k]) / cell_mm);
      cell = cell << 21 | static_cast<std::uint64_t>(std::clamp(place, 0.0, 1048575.0));
    }
    cells.push_back(cell);
  }
  std::vector<std::uint64_t> known = cells;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  Groups groups{{}, known.size()};
  groups.of_vertex.reserve(cells.size());
  for (const std::uint64_t cell : cells)
    groups.of_vertex.push_back(static_cast<std::int32_t>(
        std::lower_bound(known.begin(), known.end(), cell) - known.begin()));
  return groups;
}

/// Member of each group nearest to the mean of the group.
std::vector<std::int32_t> membersOf(const Groups& groups,
                                    const std::vector<Eigen::Vector3f>& vertices_mm) {
  std::vector<Eigen::Vector4d> sums(groups.count, Eigen::Vector4d::Zero());
  for (std::size_t i = 0; i < vertices_mm.size(); ++i)
    sums[std::size_t(groups.of_vertex[i])] += vertices_mm[i].cast<double>().homogeneous();
  std::vector<std::int32_t> members(groups.count, -1);
  std::vector<double> nearest(groups.count, 0);
  for (std::size_t i = 0; i < vertices_mm.size(); ++i) {
    const auto group = std::size_t(groups.of_vertex[i]);
    const double squared =
        (vertices_mm[i].cast<double>() - sums[group].hnormalized()).squaredNorm();
    if (members[group] >= 0 && squared >= nearest[group]) continue;
    members[group] = std::int32_t(i);
    nearest[group] = squared;
  }
  return members;
}

/// Rotated such that the lowest index is first: a canonical form.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// True if a triangle is flipped by the clustering: it would appear as a dark spot.
bool facesBack(const Triangle& fine, const std::vector<Eigen::Vector3f>& vertices_mm,
               const Triangle& joined) {
  const auto normalOf = [&](const Triangle& t) {
    const Eigen::Vector3f& a = vertices_mm[std::size_t(t[0])];
    return (vertices_mm[std::size_t(t[1])] - a).cross(vertices_mm[std::size_t(t[2])] - a).eval();
  };
  return normalOf(fine).dot(normalOf(joined)) < 0;
}

CoarseMesh join(const TriangleMesh& fine, const Groups& groups) {
  const std::vector<std::int32_t> members = membersOf(groups, fine.vertices_mm);
  CoarseMesh coarse{members, {}};
  std::sort(coarse.vertices.begin(), coarse.vertices.end());
  const auto placeOf = [&](std::int32_t fine_vertex) {
    const std::int32_t member = members[std::size_t(groups.of_vertex[std::size_t(fine_vertex)])];
    return std::int32_t(std::lower_bound(coarse.vertices.begin(), coarse.vertices.end(), member) -
                        coarse.vertices.begin());
  };
  std::set<Triangle> known;
  for (const Triangle& t : fine.triangles) {
    const Triangle joined = turned({placeOf(t[0]), placeOf(t[1]), placeOf(t[2])});
    if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
    if (facesBack(t, fine.vertices_mm,
                  {coarse.vertices[std::size_t(joined[0])], coarse.vertices[std::size_t(joined[1])],
                   coarse.vertices[std::size_t(joined[2])]}))
      continue;
    if (known.insert(joined).second) coarse.triangles.push_back(joined);
  }
  return coarse;
}

}  // namespace

TriangleMesh CoarseMesh::at(const std::vector<Eigen::Vector3f>& fine_vertices_mm) const {
  TriangleMesh mesh;
  mesh.triangles = triangles;
  for (const std::int32_t vertex : vertices)
    mesh.vertices_mm.push_back(fine_vertices_mm.at(std::size_t(vertex)));
  return mesh;
}

CoarseMesh coarsen(const TriangleMesh& fine, std::size_t most_vertices) {
  require(most_vertices > 0, "most_vertices", most_vertices, "must be above 0");
  if (fine.vertices_mm.size() <= most_vertices) {
    CoarseMesh same;
    same.vertices.resize(fine.vertices_mm.size());
    std::iota(same.vertices.begin(), same.vertices.end(), 0);
    same.triangles = fine.triangles;
    return same;
  }
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : fine.vertices_mm) box.extend(p);
  const Eigen::Vector3d low_mm = box.min().cast<double>();
  // Starts with a cell size that gives too many cells for most surfaces, then increases it.
  double cell_mm =
      std::max(double(box.diagonal().norm()) / std::sqrt(2.0 * double(most_vertices)), 1e-6);
  Groups groups = groupByCell(fine.vertices_mm, low_mm, cell_mm);
  while (groups.count > most_vertices) {
    cell_mm *= 1.25;
    groups = groupByCell(fine.vertices_mm, low_mm, cell_mm);
  }
  return join(fine, groups);
}

}  // namespace softscope
