#include "vtk_views/volumes/stored_volume.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kShortestSideMm = 1e-4, kLongestSideMm = 1e3;  // of a voxel
constexpr double kFarthestOriginMm = 1e5;
constexpr double kLeastDeterminant = 0.2;  // of unit axes; 0.87 for a gantry tilt of 30 deg

/// 3 x 3 of ±1 from a named space such as "RAS" to LPS; identity for other names.
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

/// Letter of the direction of each voxel axis, e.g. "LPS"; the nearest one if oblique.
std::string axesOf(const Eigen::Matrix3d& lps_from_voxel) {
  std::string axes;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index row = 0;
    lps_from_voxel.col(axis).cwiseAbs().maxCoeff(&row);
    axes += lps_from_voxel(row, axis) >= 0 ? "LPS"[row] : "RAI"[row];
  }
  return axes;
}

std::string lengthsText(const Eigen::Vector3d& lengths) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6g x %.6g x %.6g mm", lengths.x(), lengths.y(), lengths.z());
  return text;
}

}  // namespace

const char* const kStateSpacing = "state it with `spacing=` X,Y,Z in mm, along i, j, k";

void checkAxes(const std::string& path, const std::string& what,
               const Eigen::Matrix4d& space_from_voxel) {
  if (!space_from_voxel.allFinite())
    throw InputError(path + ": its header (" + what + ") holds a number that is not finite, so " +
                     "voxels have no place; export it again");
  const Eigen::Matrix3d axes = space_from_voxel.topLeftCorner<3, 3>();
  const Eigen::Vector3d lengths = axes.colwise().norm();
  if (!(lengths.minCoeff() >= kShortestSideMm && lengths.maxCoeff() <= kLongestSideMm))
    throw InputError(path + ": its header (" + what + ") gives voxels of " + lengthsText(lengths) +
                     ", but sides of 0.0001 to 1000 mm are expected. Is it damaged, or in another "
                     "unit? Else " +
                     kStateSpacing);
  if (!(std::abs(axes.determinant()) >= kLeastDeterminant * lengths.prod()))
    throw InputError(path + ": its voxel axes (" + what +
                     ") are coplanar, or nearly so; is the header damaged?");
  const Eigen::Vector3d origin = space_from_voxel.topRightCorner<3, 1>();
  if (!(origin.cwiseAbs().maxCoeff() <= kFarthestOriginMm))
    throw InputError(path + ": its header (" + what + ") puts the first voxel at " +
                     lengthsText(origin) + ", more than 100 m away; is it damaged?");
}

void placeVolume(Eigen::Matrix4d space_from_voxel, bool spacing_said, const VolumeOptions& options,
                 VolumeSummary& summary) {
  if (options.spacing_mm) {
    const Eigen::Matrix3d axes = space_from_voxel.topLeftCorner<3, 3>();
    const Eigen::Vector3d said = axes.colwise().norm();
    if (spacing_said && !said.isApprox(*options.spacing_mm, 1e-3))
      summary.warnings.push_back("the file says voxels of " + lengthsText(said) +
                                 "; those of --spacing were taken, " +
                                 lengthsText(*options.spacing_mm));
    for (int axis = 0; axis < 3; ++axis)
      space_from_voxel.col(axis) *= (*options.spacing_mm)[axis] / said[axis];
  }
  const Eigen::Matrix3d turn = lpsFromSpace(summary.file_space);
  summary.lps_from_voxel = space_from_voxel;
  summary.lps_from_voxel.topRows<3>() = turn * space_from_voxel.topRows<3>();
  const Eigen::Matrix3d axes = summary.lps_from_voxel.topLeftCorner<3, 3>();
  for (int axis = 0; axis < 3; ++axis)
    summary.spacing_mm[std::size_t(axis)] = axes.col(axis).norm();
  summary.axes = axesOf(axes);
  if (summary.file_space != "unknown") return;
  summary.axes = "unknown";
  summary.warnings.emplace_back(
      "the header has no patient space, so left and right are unknown; x, y, z are interpreted as "
      "LPS for surfaces");
}

}  // namespace softscope
