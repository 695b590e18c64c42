#include "features/sequence_truth.h"

#include <array>
#include <map>

namespace softscope::test {
namespace {

constexpr double kVoxelMm = 0.2;

struct VoxelMean {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), normal = position, colour = position;
  int count = 0;
};

}  // namespace

PointModel modelOfFrame(const ColourImage& colour, const Raster<float>& depth_mm,
                        const PinholeCamera& camera, const Eigen::Isometry3d& world_from_left) {
  std::map<std::array<long, 3>, VoxelMean> voxels;
  const auto lifted = [&](int u, int v) {
    return Eigen::Vector3d(liftPixel<double>(camera, u, v, depth_mm.at(u, v)));
  };
  for (int v = 1; v + 1 < depth_mm.height_px; ++v)
    for (int u = 1; u + 1 < depth_mm.width_px; ++u) {
      const Eigen::Vector3d p = lifted(u, v);
      Eigen::Vector3d normal =
          (lifted(u, v + 1) - lifted(u, v - 1)).cross(lifted(u + 1, v) - lifted(u - 1, v));
      normal.normalize();
      if (!p.allFinite() || !normal.allFinite() || !(normal.dot(p) < -0.1 * p.norm())) continue;
      const Eigen::Vector3d world = world_from_left * p;
      std::array<long, 3> key;
      for (int k = 0; k < 3; ++k)
        key[static_cast<std::size_t>(k)] = static_cast<long>(std::floor(world[k] / kVoxelMm));
      VoxelMean& voxel = voxels[key];
      const Rgb8 rgb = colour.at(u, v);
      voxel.position += world;
      voxel.normal += world_from_left.linear() * normal;
      voxel.colour += Eigen::Vector3d(rgb.red, rgb.green, rgb.blue);
      ++voxel.count;
    }
  PointModel model;
  for (const auto& [key, voxel] : voxels) {
    const Eigen::Vector3d mean = (voxel.colour / voxel.count).array().round();
    model.add((voxel.position / voxel.count).cast<float>(), voxel.normal.normalized().cast<float>(),
              {static_cast<std::uint8_t>(mean.x()), static_cast<std::uint8_t>(mean.y()),
               static_cast<std::uint8_t>(mean.z())},
              1);
  }
  return model;
}

}  // namespace softscope::test
