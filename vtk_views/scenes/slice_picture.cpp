// vtk_views/scenes/slice_picture.cpp: linear interpolation of voxels along image rows.
#include "vtk_views/scenes/slice_picture.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/error.h"
#include "core/parallel.h"

namespace softscope {

Raster<float> sliceValues(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                          int width_px, int height_px) {
  if (width_px < 1 || height_px < 1 || !(field.width_mm > 0) || !(field.height_mm > 0))
    throw Error("slice: its size must be above 0");
  const Eigen::Matrix4d voxel_from_lps = volume.facts.lps_from_voxel.inverse();
  const Eigen::Matrix3d turn = voxel_from_lps.topLeftCorner<3, 3>();
  const Eigen::Vector3d right = turn * plane.right * (field.width_mm / width_px);
  const Eigen::Vector3d down = -(turn * plane.up) * (field.height_mm / height_px);
  const Eigen::Vector3d centre = (voxel_from_lps * plane.centre_mm.homogeneous()).head<3>();
  const Eigen::Vector3d first =
      centre - (width_px - 1) / 2.0 * right - (height_px - 1) / 2.0 * down;
  Raster<float> values(width_px, height_px);
  parallelRows(height_px, [&](int v) {
    for (int u = 0; u < width_px; ++u) values.at(u, v) = volume.at(first + u * right + v * down);
  });
  return values;
}

ColourImage slicePicture(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                         const GreyWindow& window, int width_px, int height_px) {
  const Raster<float> values = sliceValues(volume, plane, field, width_px, height_px);
  ColourImage picture(width_px, height_px);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint8_t grey = window.grey(values.values[i]);
    picture.values[i] = {grey, grey, grey};
  }
  return picture;
}

}  // namespace softscope
