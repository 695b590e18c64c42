// src/mesh/coarse_mesh.cpp: vertex clustering, with members instead of means.
#include "mesh/coarse_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/error.h"

namespace softscope {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// The group of each vertex, numbered in the order of the cells.
struct Groups {
  std::vector<std::int32_t> of_vertex;
  std::size_t count = 0;
};

Groups groupByCell(const std::vector<Eigen::Vector3f>& vertices_mm, double cell_mm) {
  std::map<Cell, std::int32_t> numbers;
  std::vector<Cell> cells;
  cells.reserve(vertices_mm.size());
  for (const Eigen::Vector3f& p : vertices_mm) {
    const Eigen::Vector3d q = (p.cast<double>() / cell_mm).array().floor();
    cells.push_back({std::int64_t(q.x()), std::int64_t(q.y()), std::int64_t(q.z())});
    numbers.emplace(cells.back(), 0);
  }
  std::int32_t next = 0;
  for (auto& entry : numbers) entry.second = next++;
  Groups groups{{}, numbers.size()};
  groups.of_vertex.reserve(cells.size());
  for (const Cell& cell : cells) groups.of_vertex.push_back(numbers.at(cell));
  return groups;
}

/// The member of each group that is nearest to the group's mean.
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

/// The corner with the lowest index first, so that the same triangle is the same value.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
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
    if (known.insert(joined).second) coarse.triangles.push_back(joined);
  }
  return coarse;
}

double diagonalOf(const std::vector<Eigen::Vector3f>& vertices_mm) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : vertices_mm) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().cast<double>().norm();
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
  // A surface fills at least about this many cells of a grid as wide as its diagonal / side.
  double cell_mm = diagonalOf(fine.vertices_mm) / std::sqrt(2.0 * double(most_vertices));
  Groups groups = groupByCell(fine.vertices_mm, std::max(cell_mm, 1e-6));
  while (groups.count > most_vertices) {
    cell_mm *= 1.25;
    groups = groupByCell(fine.vertices_mm, std::max(cell_mm, 1e-6));
  }
  return join(fine, groups);
}

}  // namespace softscope
