// vtk_views/image_facts.h: from VTK's picture of a volume to ours.
#pragma once

#include <Eigen/Core>
#include <string>

#include "vtk_views/volume_summary.h"

class vtkImageData;
class vtkMatrix4x4;

namespace softscope {

Eigen::Matrix4d toEigen(vtkMatrix4x4& matrix);

/// Size, spacing (as VTK has it), type and range. Throws InputError where there are no voxels.
VolumeSummary imageFacts(vtkImageData& image, const std::string& format, const std::string& source);

/// Sets lps_from_voxel, spacing_mm and axes from the matrix into the file's own space; that space's
/// letters say which axes to turn. An unknown space is taken as LPS.
void placeInSpace(const Eigen::Matrix4d& space_from_voxel, VolumeSummary& summary);

}  // namespace softscope
