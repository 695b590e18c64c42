// vtk_views/text_header.h: the orientation that VTK's MetaImage and NRRD readers leave out.
#pragma once

#include <Eigen/Core>
#include <string>

namespace softscope {

struct HeaderGeometry {
  Eigen::Matrix4d space_from_voxel = Eigen::Matrix4d::Identity();  // mm
  std::string space = "unknown";  // "LPS", "RAS", "LAS" …, as the header says
};

/// NRRD: "space", "space directions", "space origin", "spacings".
/// MetaImage: "TransformMatrix", "Offset", "ElementSpacing"; LPS, as ITK has it.
/// Throws InputError where a number can't be read.
HeaderGeometry readNrrdGeometry(const std::string& path);
HeaderGeometry readMetaImageGeometry(const std::string& path);

}  // namespace softscope
