#include "mesh/open_mesh_check.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <vector>

namespace softscope::test {

std::string openMeshComplaint(const TriangleMesh& mesh) {
  OpenMesh::TriMesh_ArrayKernelT<> other;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const Eigen::Vector3f& v : mesh.vertices_mm)
    handles.push_back(other.add_vertex({v.x(), v.y(), v.z()}));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const auto face = other.add_face(handles.at(std::size_t(t[0])), handles.at(std::size_t(t[1])),
                                     handles.at(std::size_t(t[2])));
    if (!face.is_valid()) return "triangle " + std::to_string(i) + " doesn't fit";
  }
  for (const OpenMesh::VertexHandle vertex : handles) {
    if (other.is_isolated(vertex)) return "vertex " + std::to_string(vertex.idx()) + " is unused";
    if (!other.is_manifold(vertex))
      return "vertex " + std::to_string(vertex.idx()) + " lies on two sheets";
  }
  return {};
}

}  // namespace softscope::test
