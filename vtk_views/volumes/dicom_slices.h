// vtk_views/volumes/dicom_slices.h: tags of DICOM slices, and their order in a stack.
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
  int columns = 0, rows = 0, bits = 0, values = 0, sign = 0;  // what a pixel is made of
  Eigen::Vector3d along_row = Eigen::Vector3d::Zero(), along_column = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  // of the first pixel, LPS
  Eigen::Vector2d pixel_mm{1, 1};  // between columns, between rows; ones where the user states them
  double thickness_mm = 0;         // SpacingBetweenSlices, else SliceThickness; 0: neither
  std::string fault;               // one line, with the file; empty: all tags are as they must be
};

/// Reads and checks the geometry, the rescaling and the pixel format of every frame.
std::vector<DicomSlice> slicesOf(const std::string& file, vtkDICOMMetaData& meta,
                                 const VolumeOptions& options);

/// The stack of the slices that agree: an even grid.
struct DicomStack {
  std::vector<std::string> files;  // in the order of their slices
  std::vector<int> stored_slices;  // per slice of the stack: its frame among all frames of `files`,
                                   // -1: missing
  Eigen::Matrix4d lps_from_voxel = Eigen::Matrix4d::Identity();
  bool spacing_said = true;
  std::vector<std::string> warnings;
};

/// Throws InputError where slices are faulty, differ from the most, lie in one place or at uneven
/// distances, or some are missing; with options.allow_missing_slices faulty, different and missing
/// ones are warnings.
DicomStack stackOf(const std::string& path, std::vector<DicomSlice> slices,
                   const VolumeOptions& options);

}  // namespace softscope
