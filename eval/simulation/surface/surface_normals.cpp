// eval/simulation/surface/surface_normals.cpp: area-weighted sum of triangle normals.
#include "eval/simulation/surface/surface_normals.h"

#include <Eigen/Geometry>

namespace softscope {

std::vector<Eigen::Vector3f> vertexNormals(const std::vector<Eigen::Vector3f>& vertices_mm,
                                           const std::vector<Triangle>& triangles) {
  std::vector<Eigen::Vector3f> normals(vertices_mm.size(), Eigen::Vector3f::Zero());
  for (const Triangle& t : triangles) {
    const Eigen::Vector3f& a = vertices_mm[t[0]];
    const Eigen::Vector3f area = (vertices_mm[t[1]] - a).cross(vertices_mm[t[2]] - a);
    for (const std::int32_t vertex : t) normals[vertex] += area;
  }
  for (Eigen::Vector3f& normal : normals) normal.normalize();
  return normals;
}

}  // namespace softscope
