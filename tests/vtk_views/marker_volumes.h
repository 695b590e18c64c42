// tests/vtk_views/marker_volumes.h: one lopsided volume, written in every format and orientation.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace softscope::test {

/// Three marks of different brightness, none the mirror image of another along any axis; all else
/// is -1000. Where they lie in the patient (LPS, mm).
struct Mark {
  Eigen::Vector3d lps_mm;
  float value;
};
std::vector<Mark> marks();

struct MarkerFile {
  std::string what;  // "NRRD in RAS, oblique"
  std::filesystem::path path;
};

/// The same marks in the same places, voxels stored in another order in each: DICOM, NIfTI with
/// qform, with sform, NRRD in LPS and RAS, MetaImage; straight and oblique.
std::vector<MarkerFile> writeMarkerVolumes(const std::filesystem::path& folder);

}  // namespace softscope::test
