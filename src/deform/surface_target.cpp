#include "deform/surface_target.h"

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
                         const AssociationOptions& options)
    : depth_(depth),
      normals_(normals),
      width_px_(left.width_px),
      height_px_(left.height_px),
      fx_px_(static_cast<float>(left.fx_px)),
      fy_px_(static_cast<float>(left.fy_px)),
      cx_px_(static_cast<float>(left.cx_px)),
      cy_px_(static_cast<float>(left.cy_px)),
      left_from_world_rotation_(left_from_world.linear().cast<float>()),
      left_from_world_translation_mm_(left_from_world.translation().cast<float>()),
      squared_distance_limit_(
          static_cast<float>(options.max_distance_mm * options.max_distance_mm)),
      cosine_limit_(static_cast<float>(std::cos(options.kMaxAngleDeg * M_PI / 180))),
      use_sigma_(options.reference_sigma_mm > 0 && !depth.sigma_mm.empty()),
      reference_sigma_mm_(static_cast<float>(options.reference_sigma_mm)),
      max_reliability_(static_cast<float>(options.kMaxReliability)) {
  options.validate();
  requireShape(depth.depth_mm.width_px, depth.depth_mm.height_px, left, "depth map");
  requireShape(normals.width_px, normals.height_px, left, "normal map");
  if (!depth.sigma_mm.empty())
    requireShape(depth.sigma_mm.width_px, depth.sigma_mm.height_px, left, "map of depth errors");
}

/// docs/energy.md (11): the depth's error moves the target along its ray, so across the plane it
/// counts by the cosine between ray and normal.
float DepthTarget::reliabilityAt(int pixel, const Eigen::Vector3f& lifted_left,
                                 const Eigen::Vector3f& normal_left) const {
  if (!use_sigma_) return 1;
  const float sigma_mm = depth_.sigma_mm.values[pixel];
  if (!(sigma_mm > 0)) return 0;  // NaN too: nobody vouches for this depth
  const float across = std::abs(normal_left.dot(lifted_left)) / lifted_left.z() * sigma_mm;
  const float ratio = reference_sigma_mm_ / std::max(across, 1e-6f);
  return std::min(ratio * ratio, max_reliability_);
}

/// The pixel whose square the point falls into; -1 outside the picture or behind the camera.
int DepthTarget::pixelOf(const Eigen::Vector3f& point_left) const {
  if (!(point_left.z() > 0)) return -1;
  const float inverse_z = 1 / point_left.z();
  const float u = fx_px_ * point_left.x() * inverse_z + cx_px_ + 0.5f;
  const float v = fy_px_ * point_left.y() * inverse_z + cy_px_ + 0.5f;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(width_px_) &&
        v < static_cast<float>(height_px_)))
    return -1;
  return static_cast<int>(v) * width_px_ + static_cast<int>(u);
}

PlaneTarget DepthTarget::targetAt(int pixel, const Eigen::Vector3f& point_left,
                                  const Eigen::Vector3f& normal) const {
  PlaneTarget target;
  const float depth_mm = depth_.depth_mm.values[pixel];
  if (!(depth_mm > 0)) return target;  // NaN = unmeasured
  const int row = pixel / width_px_, column = pixel - row * width_px_;
  const Eigen::Vector3f lifted((static_cast<float>(column) - cx_px_) / fx_px_ * depth_mm,
                               (static_cast<float>(row) - cy_px_) / fy_px_ * depth_mm, depth_mm);
  if (!((lifted - point_left).squaredNorm() < squared_distance_limit_)) return target;
  const Eigen::Vector3f& normal_left = normals_.values[pixel];
  const auto world_from_left = left_from_world_rotation_.transpose();
  target.normal = world_from_left * normal_left;
  if (!(normal.dot(target.normal) > cosine_limit_)) return target;  // no normal: NaN
  target.point_mm = world_from_left * (lifted - left_from_world_translation_mm_);
  target.reliability = reliabilityAt(pixel, lifted, normal_left);
  return target;
}

/// Pixels first, so that the maps' memory is on its way while the next ones are found: measured,
/// 67,000 points in 640 x 480 pixels took 4.4 ms without and 3.0 ms with it on one core.
void DepthTarget::lookUp(const Eigen::Vector3f* points_mm, const Eigen::Vector3f* normals,
                         int count, PlaneTarget* targets) const {
  constexpr int kBatch = 64;
  int pixels[kBatch];
  Eigen::Vector3f points_left[kBatch];
  for (int first = 0; first < count; first += kBatch) {
    const int batch = std::min(kBatch, count - first);
    for (int i = 0; i < batch; ++i) {
      points_left[i] = toLeft(points_mm[first + i]);
      pixels[i] = pixelOf(points_left[i]);
      if (pixels[i] < 0) continue;
      __builtin_prefetch(&depth_.depth_mm.values[pixels[i]]);
      __builtin_prefetch(&normals_.values[pixels[i]]);
      if (use_sigma_) __builtin_prefetch(&depth_.sigma_mm.values[pixels[i]]);
    }
    for (int i = 0; i < batch; ++i)
      targets[first + i] =
          pixels[i] < 0 ? PlaneTarget() : targetAt(pixels[i], points_left[i], normals[first + i]);
  }
}

}  // namespace softscope
