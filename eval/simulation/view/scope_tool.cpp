// eval/simulation/view/scope_tool.cpp: intersection of rays with capsules.
#include "eval/simulation/view/scope_tool.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/simulation/view/view_settings.h"

namespace softscope {
namespace {

constexpr float kShaft_mm = 120;  // extends beyond any image

/// Intersection with a sphere of radius r around c, near side.
std::optional<float> meetBall(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                              const Eigen::Vector3f& centre, float radius) {
  const Eigen::Vector3f to_centre = centre - origin;
  const float a = direction.squaredNorm(), b = direction.dot(to_centre);
  const float root2 = b * b - a * (to_centre.squaredNorm() - radius * radius);
  if (root2 < 0) return std::nullopt;
  return (b - std::sqrt(root2)) / a;
}

/// Intersection with the cylinder between the spheres of the capsule.
std::optional<float> meetTube(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                              const Capsule& capsule) {
  const Eigen::Vector3f axis = capsule.to_mm - capsule.from_mm, from = origin - capsule.from_mm;
  const float aa = axis.squaredNorm(), ad = axis.dot(direction), af = axis.dot(from);
  const float a = aa * direction.squaredNorm() - ad * ad;
  const float b = aa * direction.dot(from) - ad * af;
  const float c = aa * from.squaredNorm() - af * af - capsule.radius_mm * capsule.radius_mm * aa;
  const float root2 = b * b - a * c;
  if (root2 < 0 || a <= 0) return std::nullopt;
  const float distance = (-b - std::sqrt(root2)) / a;
  const float along = af + distance * ad;
  if (along < 0 || along > aa) return std::nullopt;
  return distance;
}

Eigen::Vector3f normalAt(const Capsule& capsule, const Eigen::Vector3f& position) {
  const Eigen::Vector3f axis = capsule.to_mm - capsule.from_mm;
  const float along =
      std::clamp((position - capsule.from_mm).dot(axis) / axis.squaredNorm(), 0.0F, 1.0F);
  return (position - capsule.from_mm - along * axis).normalized();
}

}  // namespace

void ScopeToolOptions::validate() const {
  requireAllowed(*this);
  require(radius_mm == 0 || radius_mm >= 0.5, "instrument.radius_mm", radius_mm,
          "must be 0 (none) or 0.5 to 20");
}

ScopeTool::ScopeTool(const ScopeToolOptions& options, const PinholeCamera& left, double distance_mm,
                     double time_s) {
  if (!options.there()) return;
  const double side_rad = options.side_deg * M_PI / 180;
  const Eigen::Vector3d outward(std::cos(side_rad), std::sin(side_rad),
                                -0.55);  // towards the scope
  const double tip_z_mm = std::max(8.0, distance_mm - options.height_mm);
  const double half_mm = 0.5 * std::min(left.width_px, left.height_px) / left.fx_px * tip_z_mm;
  const Eigen::Vector3d tip =
      Eigen::Vector3d(0, 0, tip_z_mm) +
      options.reach * half_mm * Eigen::Vector3d(std::cos(side_rad), std::sin(side_rad), 0) +
      options.amplitude_mm * std::sin(2 * M_PI * time_s / options.period_s) * outward.normalized();
  const Eigen::Vector3f shaft = outward.normalized().cast<float>(), end = tip.cast<float>();
  const auto radius = static_cast<float>(options.radius_mm);
  const Eigen::Vector3f across = shaft.cross(Eigen::Vector3f::UnitZ()).normalized();
  const Eigen::Vector3f wrist = end + 3.2F * radius * shaft;
  const float opening = 0.55F + 0.45F * std::sin(float(2.6 * M_PI * time_s / options.period_s));
  parts_.push_back({wrist, wrist + kShaft_mm * shaft, radius});
  for (const float jaw : {-1.0F, 1.0F})
    parts_.push_back({wrist, end + jaw * (0.35F + opening) * radius * across, 0.34F * radius});
}

std::optional<ToolHit> ScopeTool::meet(const Eigen::Vector3f& origin_mm,
                                       const Eigen::Vector3f& direction, float limit) const {
  std::optional<ToolHit> nearest;
  for (const Capsule& part : parts_)
    for (const auto& distance : {meetTube(origin_mm, direction, part),
                                 meetBall(origin_mm, direction, part.from_mm, part.radius_mm),
                                 meetBall(origin_mm, direction, part.to_mm, part.radius_mm)}) {
      if (!distance || *distance <= 1 || *distance >= limit) continue;
      limit = *distance;
      nearest = ToolHit{limit, normalAt(part, origin_mm + limit * direction)};
    }
  return nearest;
}

}  // namespace softscope
