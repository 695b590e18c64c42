// vtk_views/volumes/dicom_slices.h: tags of DICOM slices, and their order in the stack.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vtk_views/volumes/volume_summary.h"

class vtkDICOMMetaData;

namespace softscope {

/// One frame of one file.
struct DicomSlice {
  std::string file;
  int frame = 0, frames = 1;                                  // of that file
  int columns = 0, rows = 0, bits = 0, values = 0, sign = 0;  // pixel format
  Eigen::Vector3d along_row = Eigen::Vector3d::Zero(), along_column = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  // of the first pixel, LPS
  Eigen::Vector2d pixel_mm{1, 1};  // between columns, between rows; 1 if given by the user
  double thickness_mm = 0;         // SpacingBetweenSlices, else SliceThickness; 0: unknown
  std::string fault;               // one line with the file name; empty: valid
};

/// Reads and checks the geometry, the rescaling and the pixel format of every frame.
std::vector<DicomSlice> slicesOf(const std::string& file, vtkDICOMMetaData& meta,
                                 const VolumeOptions& options);

/// Regular stack of consistent slices.
struct DicomStack {
  std::vector<std::string> files;  // in the order of their slices
  std::vector<int> stored_slices;  // per slice of the stack: its frame among all frames of `files`,
                                   // -1: missing
  Eigen::Matrix4d lps_from_voxel = Eigen::Matrix4d::Identity();
  bool spacing_said = true;
  std::vector<std::string> warnings;
};

/// Throws InputError for faulty, different, duplicate, unevenly
/// spaced or missing slices; with options.allow_missing_slices
/// faulty, different and missing slices are warnings.
DicomStack stackOf(const std::string& path, std::vector<DicomSlice> slices,
                   const VolumeOptions& options);

}  // namespace softscope
