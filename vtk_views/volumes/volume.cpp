#include "vtk_views/volumes/volume.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/median.h"
#include "vtk_views/volumes/volume_files.h"

namespace softscope {
namespace {

constexpr std::size_t kSamples = 200000;  // sample size of percentiles: within 0.2 % of the share

/// Lower voxel index and interpolation weight; false outside of the volume.
bool neighbours(double place, int size, int& below, float& part) {
  if (!(place >= -0.5 && place <= size - 0.5)) return false;
  const double inside = std::clamp(place, 0.0, double(size - 1));
  below = std::min(static_cast<int>(inside), std::max(size - 2, 0));
  part = static_cast<float>(inside - below);
  return true;
}

}  // namespace

float Volume::at(const Eigen::Vector3d& voxel) const {
  int low[3];
  float part[3];
  for (int axis = 0; axis < 3; ++axis)
    if (!neighbours(voxel[axis], facts.size_voxels[std::size_t(axis)], low[axis], part[axis]))
      return std::numeric_limits<float>::quiet_NaN();
  const std::size_t width = std::size_t(facts.size_voxels[0]);
  const std::size_t slice = width * std::size_t(facts.size_voxels[1]);
  const std::size_t di = facts.size_voxels[0] > 1, dj = facts.size_voxels[1] > 1 ? width : 0,
                    dk = facts.size_voxels[2] > 1 ? slice : 0;
  const float* v = values.data() + std::size_t(low[2]) * slice + std::size_t(low[1]) * width +
                   std::size_t(low[0]);
  const auto alongI = [&](const float* p) { return p[0] + part[0] * (p[di] - p[0]); };
  const auto alongJ = [&](const float* p) {
    const float near = alongI(p);
    return near + part[1] * (alongI(p + dj) - near);
  };
  const float near = alongJ(v);
  if (part[2] == 0) return near;  // the next slice may be missing
  return near + part[2] * (alongJ(v + dk) - near);
}

float Volume::atPoint(const Eigen::Vector3d& lps_mm) const {
  const Eigen::Vector4d voxel = facts.lps_from_voxel.inverse() * lps_mm.homogeneous();
  return at(voxel.head<3>());
}

bool Volume::inHounsfield() const {
  for (const auto& [name, value] : facts.details)
    if (name == "modality") return value == "CT";
  return facts.value_range[0] <= -900 && facts.value_range[1] >= 300;
}

double Volume::percentile(double share) const {
  const std::size_t step = std::max<std::size_t>(1, values.size() / kSamples);
  std::vector<float> some;
  for (std::size_t i = 0; i < values.size(); i += step)
    if (std::isfinite(values[i])) some.push_back(values[i]);
  if (some.empty()) return 0;
  return quantileOf(std::move(some), std::clamp(share, 0.0, 1.0));
}

Volume readVolume(const std::string& path, const VolumeOptions& options) {
  Volume volume = loadVolume(path, options);
  if (volume.facts.components != 1)
    throw InputError(path + ": has " + std::to_string(volume.facts.components) +
                     " values a voxel, but a CT or MR has one; colours can't be sliced");
  return volume;
}

}  // namespace softscope
