// vtk_views/scenes/view_plane.cpp: side names and letters from the axes.
#include "vtk_views/scenes/view_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace softscope {
namespace {

using Eigen::Vector3d;

constexpr double kNamed = 0.26;      // sine of 15 degrees: smaller components are not named
constexpr double kAlongAxis = 1e-6;  // tolerance of a standard plane

ViewPlane make(const char* name, const Vector3d& centre_mm, const Vector3d& right,
               const Vector3d& up) {
  return {name, centre_mm, right, up};
}

/// Up direction of the image for a view from `towards_viewer`.
Vector3d upFor(const Vector3d& towards_viewer, SceneFrame frame) {
  const Vector3d usual =
      frame != SceneFrame::kCamera ? Vector3d(Vector3d::UnitZ()) : Vector3d(-Vector3d::UnitY());
  const Vector3d other =
      frame != SceneFrame::kCamera ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
  // Within 45 degrees of the axis the view follows the axial one (for a scope: from above).
  const Vector3d& hint = std::abs(towards_viewer.dot(usual)) > std::sqrt(0.5) ? other : usual;
  return (hint - hint.dot(towards_viewer) * towards_viewer).normalized();
}

ViewPlane lookFrom(const char* name, const Vector3d& centre_mm, const Vector3d& towards_viewer,
                   SceneFrame frame) {
  const Vector3d up = upFor(towards_viewer, frame);
  return make(name, centre_mm, up.cross(towards_viewer), up);
}

using SideNames = std::array<std::array<const char*, 2>, 3>;  // by axis, then sign

const SideNames& namesOf(SceneFrame frame) {
  static const SideNames kLetters{{{"R", "L"}, {"A", "P"}, {"I", "S"}}};
  static const SideNames kWords{{{"left", "right"}, {"up", "down"}, {"near", "far"}}};
  static const SideNames kSigns{{{"-x", "+x"}, {"-y", "+y"}, {"-z", "+z"}}};
  if (frame == SceneFrame::kPatient) return kLetters;
  return frame == SceneFrame::kCamera ? kWords : kSigns;
}

Vector3d unitOf(const Vector3d& direction) {
  if (!(direction.norm() > 1e-9) || !direction.allFinite())
    throw OptionError("a direction must be three numbers that aren't all 0");
  return direction.normalized();
}

/// Anatomical names require a known space.
const char* planeName(SceneFrame frame, const char* anatomical, const char* by_axes) {
  return frame == SceneFrame::kAxes ? by_axes : anatomical;
}

/// "L 12.0" for a patient, "x 12.0" otherwise.
std::string sideText(Eigen::Index axis, double value, int decimals, SceneFrame frame) {
  char text[48];
  if (frame == SceneFrame::kPatient)
    std::snprintf(text, sizeof text, "%c %.*f", (value < 0 ? "RAI" : "LPS")[axis], decimals,
                  std::abs(value));
  else
    std::snprintf(text, sizeof text, "%c %.*f", "xyz"[axis], decimals, value);
  return text;
}

}  // namespace

ViewPlane axialView(const Vector3d& centre_mm, SceneFrame frame, SideRule rule) {
  const Vector3d front = -Vector3d::UnitY();
  if (frame == SceneFrame::kCamera)
    return make("from the scope", centre_mm, Vector3d::UnitX(), front);
  const double side = rule == SideRule::kRadiological ? 1 : -1;
  return make(planeName(frame, "axial", "xy plane"), centre_mm, side * Vector3d::UnitX(), front);
}

ViewPlane coronalView(const Vector3d& centre_mm, SceneFrame frame, SideRule rule) {
  if (frame == SceneFrame::kCamera)
    return make("from above", centre_mm, Vector3d::UnitX(), Vector3d::UnitZ());
  const double side = rule == SideRule::kRadiological ? 1 : -1;
  return make(planeName(frame, "coronal", "xz plane"), centre_mm, side * Vector3d::UnitX(),
              Vector3d::UnitZ());
}

ViewPlane sagittalView(const Vector3d& centre_mm, SceneFrame frame) {
  if (frame == SceneFrame::kCamera)
    return make("from the right", centre_mm, Vector3d::UnitZ(), -Vector3d::UnitY());
  return make(planeName(frame, "sagittal", "yz plane"), centre_mm, Vector3d::UnitY(),
              Vector3d::UnitZ());
}

ViewPlane obliqueView(const Vector3d& centre_mm, const Vector3d& normal, SceneFrame frame,
                      SideRule rule) {
  const Vector3d n = unitOf(normal);
  Eigen::Index axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  const ViewPlane nearest = axis == 0   ? sagittalView(centre_mm, frame)
                            : axis == 1 ? coronalView(centre_mm, frame, rule)
                                        : axialView(centre_mm, frame, rule);
  const Vector3d towards_viewer = n.dot(nearest.towardsViewer()) < 0 ? Vector3d(-n) : n;
  const Vector3d up = (nearest.up - nearest.up.dot(n) * n).normalized();
  Vector3d right = up.cross(towards_viewer);
  // A sagittal view has no left; one beside it that names it keeps the rule of the others.
  const double left = rule == SideRule::kRadiological ? right.x() : -right.x();
  if (frame != SceneFrame::kCamera && left < -kNamed) right = -right;
  return make("oblique", centre_mm, right, up);
}

ViewPlane cameraView(const Vector3d& centre_mm, const Vector3d& towards_viewer, SceneFrame frame) {
  return lookFrom("3-D", centre_mm, unitOf(towards_viewer), frame);
}

std::string sideName(const Vector3d& direction, SceneFrame frame) {
  const Vector3d unit = direction.normalized();
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return std::abs(unit[a]) > std::abs(unit[b]); });
  std::string name;
  for (const int axis : order) {
    if (std::abs(unit[axis]) < kNamed) continue;
    if (frame != SceneFrame::kPatient && !name.empty()) break;  // long words: the strongest only
    name += namesOf(frame)[std::size_t(axis)][unit[axis] > 0 ? 1 : 0];
  }
  return name;
}

std::string positionText(const ViewPlane& plane, SceneFrame frame) {
  const Vector3d normal = plane.towardsViewer();
  Eigen::Index axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) < 1 - kAlongAxis) return {};
  return sideText(axis, plane.centre_mm[axis], 1, frame) + " mm";
}

std::string sidesText(const Vector3d& vector, int decimals, SceneFrame frame) {
  std::string text;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    text += (axis > 0 ? ", " : "") + sideText(axis, vector[axis], decimals, frame);
  return text;
}

}  // namespace softscope
