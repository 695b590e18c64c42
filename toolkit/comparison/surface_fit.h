// toolkit/comparison/surface_fit.h: alignment of a test surface to its reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/alignment/landmark_errors.h"
#include "eval/surfaces/surface_alignment.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct SurfaceFitOptions {
  std::string landmarks;  // file of point pairs; empty: none
  bool closest_points = false;
  std::string transform;  // file of reference_from_test (readTransform()); empty: none

  bool moves() const { return closest_points || !landmarks.empty() || !transform.empty(); }
};

/// Rigid transform, mm: 3 or 4 rows of 4 numbers; # begins a comment. Throws InputError:
/// a wrong count of numbers, an invalid rotation, a last row other than 0 0 0 1.
Eigen::Isometry3d readTransform(const std::string& file);

/// From --align (may be empty) and --landmarks: a landmark file without
/// --align means landmarks, with icp it gives the initial alignment. Throws
/// OptionError: an unknown method, landmarks without a file, none with a file.
SurfaceFitOptions parseFit(const std::string& align, const std::string& landmarks,
                           const std::string& landmarks_option);

struct SurfaceFit {
  // none, landmarks, given, icp, "landmarks, then icp", "given, then icp"
  std::string method = "none";
  Eigen::Isometry3d reference_from_test = Eigen::Isometry3d::Identity();
  std::optional<Statistics> before_mm;  // distances of the test before alignment
  std::optional<LandmarkErrors> landmarks;
  std::optional<SurfaceAlignment> icp;
  std::vector<std::string> warnings;
};

/// Computes the alignment only. Throws InputError for unreadable landmarks.
SurfaceFit fitSurface(const TriangleMesh& reference, const std::vector<Eigen::Vector3f>& test_mm,
                      const SurfaceFitOptions& options);

FactSheet::Json surfaceFitJson(const SurfaceFit& fit);
void addFitFacts(const SurfaceFit& fit, FactSheet& facts);

}  // namespace softscope
