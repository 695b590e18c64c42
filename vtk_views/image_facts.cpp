// vtk_views/image_facts.cpp: size, spacing, where left and right are.
#include "vtk_views/image_facts.h"

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>

#include "core/error.h"

namespace softscope {
namespace {

/// 3 x 3 of ±1 that turns an axis-named space such as "RAS" into LPS; identity for other names.
Eigen::Matrix3d lpsFromSpace(const std::string& space) {
  if (space.size() != 3 || space == "unknown") return Eigen::Matrix3d::Identity();
  const std::string positive = "LPS", negative = "RAI";
  Eigen::Matrix3d lps_from_space = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto plus = positive.find(space[std::size_t(axis)]);
    const auto minus = negative.find(space[std::size_t(axis)]);
    if (plus != std::string::npos) lps_from_space(Eigen::Index(plus), axis) = 1;
    if (minus != std::string::npos) lps_from_space(Eigen::Index(minus), axis) = -1;
  }
  return lps_from_space;
}

/// The letter of the side that each voxel axis runs to, e.g. "LPS"; the nearest one where oblique.
std::string axesOf(const Eigen::Matrix3d& lps_from_voxel) {
  std::string axes;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index row = 0;
    lps_from_voxel.col(axis).cwiseAbs().maxCoeff(&row);
    axes += lps_from_voxel(row, axis) >= 0 ? "LPS"[row] : "RAI"[row];
  }
  return axes;
}

}  // namespace

Eigen::Matrix4d toEigen(vtkMatrix4x4& matrix) {
  Eigen::Matrix4d result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result(row, column) = matrix.GetElement(row, column);
  return result;
}

VolumeSummary imageFacts(vtkImageData& image, const std::string& format,
                         const std::string& source) {
  VolumeSummary summary;
  summary.format = format;
  image.GetDimensions(summary.size_voxels.data());
  image.GetSpacing(summary.spacing_mm.data());
  if (image.GetNumberOfPoints() == 0 || image.GetPointData() == nullptr ||
      image.GetNumberOfScalarComponents() == 0)
    throw InputError(source + ": has no voxels. Is it complete?");
  summary.scalar_type = image.GetScalarTypeAsString();
  summary.components = image.GetNumberOfScalarComponents();
  image.GetScalarRange(summary.value_range.data());
  return summary;
}

void placeInSpace(const Eigen::Matrix4d& space_from_voxel, VolumeSummary& summary) {
  const Eigen::Matrix3d turn = lpsFromSpace(summary.file_space);
  summary.lps_from_voxel = space_from_voxel;
  summary.lps_from_voxel.topRows<3>() = turn * space_from_voxel.topRows<3>();
  const Eigen::Matrix3d axes = summary.lps_from_voxel.topLeftCorner<3, 3>();
  for (int axis = 0; axis < 3; ++axis)
    summary.spacing_mm[std::size_t(axis)] = axes.col(axis).norm();
  summary.axes = axesOf(axes);
  if (summary.file_space == "unknown")
    summary.warnings.emplace_back("the header names no patient space; taken as LPS");
}

}  // namespace softscope
