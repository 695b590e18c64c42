// eval/simulation/tissue/tissue_body.cpp: vertices and normals interpolated from the organ.
#include "eval/simulation/tissue/tissue_body.h"

#include "eval/simulation/surface/surface_normals.h"

namespace softscope {

TissueBody TissueBody::whole(TriangleMesh organ) {
  TissueBody body;
  body.mesh = organ;
  body.skin_triangles = organ.triangles.size();
  body.organ = std::move(organ);
  return body;
}

std::vector<Eigen::Vector3f> TissueBody::verticesAt(const std::vector<Eigen::Vector3f>& organ_mm,
                                                    float open) const {
  if (places.empty()) return organ_mm;
  std::vector<Eigen::Vector3f> vertices = organ_mm;
  vertices.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i >= organ_mm.size()) vertices[i] = places[i].mixed(organ_mm) + below_mm[i];
    vertices[i] += open * gape_mm[i];
  }
  return vertices;
}

std::vector<Eigen::Vector3f> TissueBody::normalsOf(
    const std::vector<Eigen::Vector3f>& vertices_mm) const {
  if (places.empty()) return vertexNormals(vertices_mm, mesh.triangles);
  const std::vector<Eigen::Vector3f> organ_mm(vertices_mm.begin(),
                                              vertices_mm.begin() + organ.vertices_mm.size());
  const std::vector<Triangle> walls(mesh.triangles.begin() + skin_triangles, mesh.triangles.end());
  const std::vector<Eigen::Vector3f> of_organ = vertexNormals(organ_mm, organ.triangles);
  std::vector<Eigen::Vector3f> normals = vertexNormals(vertices_mm, walls);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (i < of_organ.size())
      normals[i] = of_organ[i];
    else if (depth_mm[i] == 0)
      normals[i] = places[i].mixed(of_organ);
  return normals;
}

std::vector<Triangle> TissueBody::visibleTriangles(float open) const {
  if (open > 0) return mesh.triangles;
  return {mesh.triangles.begin(), mesh.triangles.begin() + skin_triangles};
}

}  // namespace softscope
