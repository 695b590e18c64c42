#include "fusion/observation.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/pixel_formulas.h"

namespace softscope {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class T>
void requireShape(const Raster<T>& raster, const PinholeCamera& left, const char* what) {
  if (raster.width_px == left.width_px && raster.height_px == left.height_px) return;
  throw OptionError(std::string("fusion: the ") + what + " is " + std::to_string(raster.width_px) +
                    "x" + std::to_string(raster.height_px) + ", but the camera is " +
                    std::to_string(left.width_px) + "x" + std::to_string(left.height_px));
}

/// Nearest and farthest depth of the 2 r + 1 pixels around each of a row; infinities if none.
void spanRow(const float* depth_mm, int width, int radius, float* nearest, float* farthest) {
  for (int u = 0; u < width; ++u) nearest[u] = kInfinity, farthest[u] = -kInfinity;
  for (int x = -radius; x <= radius; ++x) {
    const int first = std::max(0, -x), last = std::min(width, width - x);
    for (int u = first; u < last; ++u) {
      const float z = depth_mm[u + x];
      nearest[u] = z < nearest[u] ? z : nearest[u];  // false for NaN
      farthest[u] = z > farthest[u] ? z : farthest[u];
    }
  }
}

/// The same over rows v - r to v + r.
void spanColumn(const Raster<float>& row_nearest, const Raster<float>& row_farthest, int v,
                int radius, float* nearest, float* farthest) {
  const int width = row_nearest.width_px;
  std::fill(nearest, nearest + width, kInfinity);
  std::fill(farthest, farthest + width, -kInfinity);
  const int last = std::min(row_nearest.height_px - 1, v + radius);
  for (int y = std::max(0, v - radius); y <= last; ++y) {
    const float *near_row = row_nearest.row(y), *far_row = row_farthest.row(y);
    for (int u = 0; u < width; ++u) {
      nearest[u] = near_row[u] < nearest[u] ? near_row[u] : nearest[u];
      farthest[u] = far_row[u] > farthest[u] ? far_row[u] : farthest[u];
    }
  }
}

}  // namespace

void Observation::validate() const {
  if (!(left.fx_px > 0 && left.fy_px > 0))
    throw OptionError("fusion: the camera has no focal length; set fx_px and fy_px");
  if (!world_from_left.matrix().allFinite())
    throw OptionError("fusion: the camera's pose is not finite");
  requireShape(depth.depth_mm, left, "depth map");
  requireShape(normals, left, "normal map");
  if (!depth.sigma_mm.empty()) requireShape(depth.sigma_mm, left, "map of depth errors");
  if (!colour.empty()) requireShape(colour, left, "picture");
  if (!mask.empty()) requireShape(mask, left, "mask");
}

PosedCamera posedCamera(const PinholeCamera& left, const Eigen::Isometry3d& world_from_left) {
  const Eigen::Isometry3d left_from_world = world_from_left.inverse();
  PosedCamera camera;
  camera.left_from_world = left_from_world.linear().cast<float>();
  camera.left_from_world_mm = left_from_world.translation().cast<float>();
  camera.fx_px = static_cast<float>(left.fx_px);
  camera.fy_px = static_cast<float>(left.fy_px);
  camera.cx_px = static_cast<float>(left.cx_px);
  camera.cy_px = static_cast<float>(left.cy_px);
  camera.width_px = left.width_px;
  camera.height_px = left.height_px;
  return camera;
}

Raster<PixelState> classifyPixels(const Observation& observation, const PixelOptions& options) {
  options.validate();
  observation.validate();
  const PosedCamera camera = posedCamera(observation.left, observation.world_from_left);
  const Raster<float>& depth_mm = observation.depth.depth_mm;
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  Raster<float> nearest(width, height), farthest(width, height);
  parallelRows(height, [&](int v) {
    spanRow(depth_mm.row(v), width, options.kEdgeRadiusPx, nearest.row(v), farthest.row(v));
  });
  Raster<PixelState> states(width, height, PixelState::kUnmeasured);
  const FrameRasters rasters = frameRasters(observation);
  const float max_sigma_mm = static_cast<float>(options.max_sigma_mm);
  parallelRanges(height, 8, [&](int begin, int end) {
    std::vector<float> low(static_cast<std::size_t>(width)), high(low.size());
    for (int v = begin; v < end; ++v) {
      spanColumn(nearest, farthest, v, options.kEdgeRadiusPx, low.data(), high.data());
      for (int u = 0; u < width; ++u) {
        const bool is_masked = !observation.mask.empty() && observation.mask.at(u, v) != 0;
        states.at(u, v) =
            pixelState(u, v, is_masked, {low[u], high[u]}, rasters, camera, max_sigma_mm);
      }
    }
  });
  return states;
}

}  // namespace softscope
