// vtk_views/volume_files.h: a volume as VTK holds it.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <string>

#include "vtk_views/volume_summary.h"

namespace softscope {

/// Stored values in the file's order; VTK's own origin and spacing mean nothing here, the summary's
/// lps_from_voxel tells where voxels lie.
struct LoadedVolume {
  VolumeSummary summary;
  vtkSmartPointer<vtkImageData> image;
  double slope = 1, intercept = 0;  // value = slope * stored + intercept
};

/// summariseVolume() with the voxels.
LoadedVolume loadVolume(const std::string& path, bool with_patient);

}  // namespace softscope
