// vtk_views/scenes/view_plane.h: direction and axes of a view.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace softscope {

/// Meaning of the axes of a scene, for side names.
enum class SceneFrame {
  kPatient,  // LPS: x to the patient's left, y to the back, z to the head
  kCamera,   // camera frame: x right, y down, z forward
  kAxes,     // unknown: viewed like a patient, sides named +x, -x …
};

/// Orientation of the image.
enum class SideRule {
  kRadiological,  // facing the patient, axial from the feet: patient's left on the right
  kNeurological,  // from behind, axial from the head: left on the left
};

/// Plane, or camera direction, with right and
/// up of the image: orthogonal unit vectors.
struct ViewPlane {
  std::string name;  // "axial"
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();

  Eigen::Vector3d towardsViewer() const { return right.cross(up); }
  /// Right and up components relative to the centre, mm.
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d offset = point_mm - centre_mm;
    return {right.dot(offset), up.dot(offset)};
  }
};

// The three standard views through a point. For a patient: axial from the feet, front up;
// coronal from the front and sagittal from the left, head up. For a camera frame: from the
// scope, from above, and from its right. The sagittal view does not depend on the side rule.

ViewPlane axialView(const Eigen::Vector3d& centre_mm, SceneFrame frame, SideRule rule);
ViewPlane coronalView(const Eigen::Vector3d& centre_mm, SceneFrame frame, SideRule rule);
ViewPlane sagittalView(const Eigen::Vector3d& centre_mm, SceneFrame frame);

/// Any other plane, with side and up direction of the nearest standard view; for a patient, from
/// the other side where left would be named on the wrong side. Throws OptionError for a zero
/// `normal`.
ViewPlane obliqueView(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& normal,
                      SceneFrame frame, SideRule rule);

/// Camera on the side of `towards_viewer`, with an up direction close to that of the scene.
ViewPlane cameraView(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& towards_viewer,
                     SceneFrame frame);

/// Name of a direction: for a patient one to three of R L A P S I, the
/// strongest first ("L", "SA"); for a camera frame one word ("right", "far").
std::string sideName(const Eigen::Vector3d& direction, SceneFrame frame);

/// Position or direction by sides, "L 12.0, P 3.5, S 30.0"; by x, y, z if these are unknown.
std::string sidesText(const Eigen::Vector3d& vector, int decimals, SceneFrame frame);

/// Position of a plane along its normal, "S 1602.3 mm", "x -4.0 mm"; empty for an oblique plane.
std::string positionText(const ViewPlane& plane, SceneFrame frame);

}  // namespace softscope
