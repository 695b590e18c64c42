// src/mesh/hole_closing.cpp: border loops by OpenMesh.
#include "mesh/hole_closing.h"

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <vector>

#include "core/error.h"

namespace softscope {
namespace {

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

HalfedgeMesh halfedgesOf(const TriangleMesh& mesh) {
  HalfedgeMesh halfedges;
  std::vector<HalfedgeMesh::VertexHandle> vertices;
  for (const Eigen::Vector3f& p : mesh.vertices_mm)
    vertices.push_back(halfedges.add_vertex({p.x(), p.y(), p.z()}));
  for (const Triangle& t : mesh.triangles)
    if (!halfedges.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid())
      throw Error("holes can be closed of oriented manifolds alone");
  return halfedges;
}

/// Vertices around each hole, in the orientation of faces that fill it.
std::vector<std::vector<std::int32_t>> holesOf(const HalfedgeMesh& halfedges) {
  std::vector<bool> seen(halfedges.n_halfedges(), false);
  std::vector<std::vector<std::int32_t>> holes;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    HalfedgeMesh::HalfedgeHandle side(static_cast<int>(i));
    if (!halfedges.is_boundary(side) || seen[i]) continue;
    holes.emplace_back();
    while (!seen[static_cast<std::size_t>(side.idx())]) {
      seen[static_cast<std::size_t>(side.idx())] = true;
      holes.back().push_back(halfedges.from_vertex_handle(side).idx());
      side = halfedges.next_halfedge_handle(side);
    }
  }
  return holes;
}

void addLid(const std::vector<std::int32_t>& hole, TriangleMesh& mesh) {
  if (hole.size() == 3) return mesh.triangles.push_back({hole[0], hole[1], hole[2]});
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::int32_t vertex : hole) sum += mesh.vertices_mm[vertex].cast<double>();
  const auto middle = static_cast<std::int32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.push_back((sum / double(hole.size())).cast<float>());
  if (!mesh.colours.empty()) mesh.colours.push_back(mesh.colours[hole[0]]);
  for (std::size_t i = 0; i < hole.size(); ++i)
    mesh.triangles.push_back({hole[i], hole[(i + 1) % hole.size()], middle});
}

}  // namespace

ClosedHoles closeHoles(TriangleMesh& mesh, double widest_mm) {
  ClosedHoles result;
  for (const std::vector<std::int32_t>& hole : holesOf(halfedgesOf(mesh))) {
    Eigen::AlignedBox3f box;
    for (const std::int32_t vertex : hole) box.extend(mesh.vertices_mm[vertex]);
    const double wide_mm = box.diagonal().norm();
    if (wide_mm > widest_mm || hole.size() < 3) {
      ++result.left_open;
      continue;
    }
    addLid(hole, mesh);
    ++result.closed;
    result.edges += static_cast<int>(hole.size());
    result.widest_mm = std::max(result.widest_mm, wide_mm);
  }
  return result;
}

}  // namespace softscope
