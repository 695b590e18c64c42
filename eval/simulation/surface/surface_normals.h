// eval/simulation/surface/surface_normals.h: vertex normals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Outward unit normals, one per vertex, weighted by
/// triangle areas; zero for a vertex without triangles.
std::vector<Eigen::Vector3f> vertexNormals(const std::vector<Eigen::Vector3f>& vertices_mm,
                                           const std::vector<Triangle>& triangles);

}  // namespace softscope
