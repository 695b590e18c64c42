// vtk_views/scenes/view_plane.h: direction and axes of a view.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace softscope {

/// What the axes of a scene mean, so that sides can be named.
enum class SceneFrame {
  kPatient,  // LPS: x to the patient's left, y to the back, z to the head
  kCamera,   // a scope's: x right, y down, z away from it
  kAxes,     // not said: looked at as a patient, but sides are called +x, -x …
};

/// Whose left is on the left of the image.
enum class SideRule {
  kRadiological,  // as if facing the patient, axial from the feet: patient's left on the right
  kNeurological,  // as if standing behind, axial from the head: left on the left
};

/// A plane, or the direction of a camera, with the image's own right and up: unit vectors, at
/// right angles.
struct ViewPlane {
  std::string name;  // "axial"
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();

  Eigen::Vector3d towardsViewer() const { return right.cross(up); }
  /// Right and up of a point from the centre, mm.
  Eigen::Vector2d project(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector3d offset = point_mm - centre_mm;
    return {right.dot(offset), up.dot(offset)};
  }
};

// The three standard views through a point. Of a patient: axial from the feet, front up; coronal
// from the front and sagittal from the left, head up. Of a scope's scene: as the scope sees it,
// from above, and from its right. The sagittal view is the same by both side rules.

ViewPlane axialView(const Eigen::Vector3d& centre_mm, SceneFrame frame, SideRule rule);
ViewPlane coronalView(const Eigen::Vector3d& centre_mm, SceneFrame frame, SideRule rule);
ViewPlane sagittalView(const Eigen::Vector3d& centre_mm, SceneFrame frame);

/// Any other plane. Which of its sides is looked at, and what is up, follows the standard view that
/// is nearest. Throws OptionError where `normal` has no length.
ViewPlane obliqueView(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& normal,
                      SceneFrame frame, SideRule rule);

/// A camera on the side that `towards_viewer` names, its up as near to the scene's as can be.
ViewPlane cameraView(const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& towards_viewer,
                     SceneFrame frame);

/// The side that a direction leads to: of a patient one to three of R L A P S I, the strongest
/// first ("L", "SA"); of a camera's frame the strongest in a word ("right", "far").
std::string sideName(const Eigen::Vector3d& direction, SceneFrame frame);

/// A place or direction by its sides, "L 12.0, P 3.5, S 30.0"; by x, y, z where these are unknown.
std::string sidesText(const Eigen::Vector3d& vector, int decimals, SceneFrame frame);

/// Where along its normal a plane lies, "S 1602.3 mm", "x -4.0 mm"; empty for an oblique one.
std::string positionText(const ViewPlane& plane, SceneFrame frame);

}  // namespace softscope
