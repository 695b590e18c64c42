// toolkit/comparison/compare_inputs.h: input files of a comparison: surfaces, points and landmarks.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// STL, PLY, OBJ, VTP or VTK; a PLY without faces, as written by
/// `reconstruct`, becomes a mesh without triangles. Throws InputError.
TriangleMesh readSurfaceOrPoints(const std::filesystem::path& file, double unit_mm);

/// Corresponding points, mm.
struct Landmarks {
  std::vector<Eigen::Vector3d> test_mm, reference_mm;
};

/// CSV: test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,reference_z_mm;
/// other columns are ignored. Throws InputError: too few pairs, a missing coordinate.
Landmarks readLandmarks(const std::filesystem::path& file);

/// Transforms the test into the space of the reference if they differ (LPS and RAS: opposite signs
/// of x and y). If one header alone names a space, the other file is taken for LPS; if none does,
/// they are equal. Returns a description of the change or assumption.
std::string matchSpaces(const TriangleMesh& reference, TriangleMesh& test);

}  // namespace softscope
