// toolkit/comparison/compare_inputs.h: surfaces, points and landmarks to compare.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// STL, PLY, OBJ, VTP or VTK; a PLY without faces, as `reconstruct` writes its models, becomes a
/// mesh without triangles. Throws InputError.
TriangleMesh readSurfaceOrPoints(const std::filesystem::path& file, double unit_mm);

/// Pairs of points, mm.
struct Landmarks {
  std::vector<Eigen::Vector3d> test_mm, reference_mm;
};

/// CSV: test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm; other columns,
/// such as names, are left out. Throws InputError: too few, or a coordinate that lacks.
Landmarks readLandmarks(const std::filesystem::path& file);

/// Brings the test into the reference's space where both headers say theirs and they differ (LPS
/// and RAS: x and y change sign). Returns a line that says what was done or assumed.
std::string matchSpaces(const TriangleMesh& reference, TriangleMesh& test);

}  // namespace softscope
