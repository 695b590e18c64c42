#include "deform/energy/surface_target.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

void requireShape(int width_px, int height_px, const PinholeCamera& left, const char* what) {
  if (width_px == left.width_px && height_px == left.height_px) return;
  throw OptionError(std::string("DepthTarget: the ") + what + " is " + std::to_string(width_px) +
                    "x" + std::to_string(height_px) + ", but the camera " +
                    std::to_string(left.width_px) + "x" + std::to_string(left.height_px));
}

}  // namespace

DepthTarget::DepthTarget(const DepthMap& depth, const NormalMap& normals, const PinholeCamera& left,
                         const Eigen::Isometry3d& left_from_world,
                         const AssociationOptions& options) {
  options.validate();
  requireShape(depth.depth_mm.width_px, depth.depth_mm.height_px, left, "depth map");
  requireShape(normals.width_px, normals.height_px, left, "normal map");
  if (!depth.sigma_mm.empty())
    requireShape(depth.sigma_mm.width_px, depth.sigma_mm.height_px, left, "map of depth errors");
  look_up_.depth_mm = depth.depth_mm.values.data();
  look_up_.normals = normals.values.data();
  look_up_.sigma_mm = depth.sigma_mm.values.data();
  look_up_.width_px = left.width_px;
  look_up_.height_px = left.height_px;
  look_up_.fx_px = static_cast<float>(left.fx_px);
  look_up_.fy_px = static_cast<float>(left.fy_px);
  look_up_.cx_px = static_cast<float>(left.cx_px);
  look_up_.cy_px = static_cast<float>(left.cy_px);
  look_up_.left_from_world_rotation = left_from_world.linear().cast<float>();
  look_up_.left_from_world_translation_mm = left_from_world.translation().cast<float>();
  look_up_.squared_distance_limit =
      static_cast<float>(options.max_distance_mm * options.max_distance_mm);
  look_up_.cosine_limit = static_cast<float>(std::cos(options.kMaxAngleDeg * M_PI / 180));
  look_up_.use_sigma = options.reference_sigma_mm > 0 && !depth.sigma_mm.empty();
  look_up_.reference_sigma_mm = static_cast<float>(options.reference_sigma_mm);
  look_up_.max_reliability = static_cast<float>(options.kMaxReliability);
}

/// Pixels first, so that the maps are prefetched while the next ones are found: measured,
/// 67,000 points in 640 x 480 pixels took 4.4 ms without and 3.0 ms with it on one core.
void DepthTarget::lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals,
                         int count, PlaneTarget* targets) const {
  constexpr int kBatch = 64;
  int pixels[kBatch];
  Eigen::Vector3f points_left[kBatch];
  for (int first = 0; first < count; first += kBatch) {
    const int batch = std::min(kBatch, count - first);
    for (int i = 0; i < batch; ++i) {
      points_left[i] = look_up_.toLeft(points_mm[first + i]);
      pixels[i] = look_up_.pixelOf(points_left[i]);
      if (pixels[i] < 0) continue;
      __builtin_prefetch(&look_up_.depth_mm[pixels[i]]);
      __builtin_prefetch(&look_up_.normals[pixels[i]]);
      if (look_up_.use_sigma) __builtin_prefetch(&look_up_.sigma_mm[pixels[i]]);
    }
    for (int i = 0; i < batch; ++i)
      targets[first + i] = pixels[i] < 0
                               ? PlaneTarget()
                               : look_up_.targetAt(pixels[i], points_left[i], normals[first + i]);
  }
}

}  // namespace softscope
