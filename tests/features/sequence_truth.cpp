#include "features/sequence_truth.h"

#include <Eigen/QR>
#include <array>
#include <fstream>
#include <map>

namespace softscope::test {
namespace {

constexpr double kVoxelMm = 0.2;

struct VoxelMean {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), normal = position, colour = position;
  int count = 0;
};

}  // namespace

SequenceTruth::SequenceTruth(const std::filesystem::path& folder)
    : poses(readTrajectory(folder / "groundtruth" / "trajectory.txt")) {
  camera = readCalibration(folder).left.pinhole;
  std::ifstream file(folder / "groundtruth" / "tracks.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream text(line);
    std::size_t frame, id;
    Eigen::Vector3d p;
    text >> frame >> id >> p.x() >> p.y() >> p.z();
    if (tracks_mm.size() <= frame) tracks_mm.resize(frame + 1);
    tracks_mm[frame].push_back(p);
  }
}

bool TrueFlow::at(const Eigen::Vector2d& place, Eigen::Vector2d* shift_px) const {
  constexpr double kReachPx = 34, kLargestResidualPx = 0.15;
  Eigen::MatrixXd places(from_.size(), 3), shifts(from_.size(), 2);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const Eigen::Vector2d apart = from_[i] - place;
    if (apart.norm() > kReachPx) continue;
    const double weight = 1.1 - apart.norm() / kReachPx;
    places.row(count) = weight * Eigen::RowVector3d(1, apart.x(), apart.y());
    shifts.row(count++) = weight * shift_[i].transpose();
  }
  if (count < 5) return false;
  const Eigen::MatrixXd fit =
      places.topRows(count).householderQr().solve(shifts.topRows(count)).eval();
  const Eigen::MatrixXd residuals = places.topRows(count) * fit - shifts.topRows(count);
  *shift_px = fit.row(0).transpose();
  return residuals.rowwise().norm().mean() < kLargestResidualPx;
}

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
