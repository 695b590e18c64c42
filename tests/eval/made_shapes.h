// tests/eval/made_shapes.h: surfaces with known answers.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Closed surface around the origin whose radius, mm, is a function of the direction: `rings` of
/// `segments` vertices between two poles, 2 * segments * rings triangles.
TriangleMesh makeStarShape(int segments, int rings,
                           const std::function<double(const Eigen::Vector3d&)>& radius_mm);

/// A sphere's polyhedron, as above.
TriangleMesh makeSphere(int segments, int rings, double radius_mm);

/// About 120 mm long, with lobes and folds; 99 000 triangles at (250, 198).
TriangleMesh makeOrgan(int segments, int rings);

/// Open rectangle in the plane z = 0, from the origin to (width, height), of columns x rows x 2
/// triangles that face +z.
TriangleMesh makeRectangle(double width_mm, double height_mm, int columns, int rows);

/// Box from `low_mm` to `high_mm`, 12 triangles that face outwards.
TriangleMesh makeBox(const Eigen::Vector3f& low_mm, const Eigen::Vector3f& high_mm);

/// Triangles without neighbours, anywhere in a cube of `extent_mm`.
TriangleMesh makeSoup(int triangles, float extent_mm, float size_mm, std::mt19937& random);

/// Points within `reach_mm` of random places on the mesh's triangles.
std::vector<Eigen::Vector3f> pointsNear(const TriangleMesh& mesh, int count, float reach_mm,
                                        std::mt19937& random);

/// Points anywhere in the cube from -extent_mm to extent_mm.
std::vector<Eigen::Vector3f> pointsInCube(int count, float extent_mm, std::mt19937& random);

}  // namespace softscope
