// vtk_views/scenes/scene.h: surfaces, points and volume of a figure in one frame.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/scenes/view_plane.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Surface, or points for a mesh without triangles.
struct SceneSurface {
  std::string name;  // in the legend; empty: not in the legend
  TriangleMesh mesh;
  Rgb8 colour{230, 159, 0};
  /// Computed elsewhere: empty, or one per vertex, mm; NaN = not observed.
  std::vector<double> errors_mm;
  double dot_scale = 1;   // line and point size in slices, in line widths
  bool in_3d = true;      // also drawn in 3-D panels
  bool in_focus = false;  // determines centre and size of the view

  bool isPoints() const { return mesh.triangles.empty(); }
};

/// All in mm, in one frame.
struct Scene {
  SceneFrame frame = SceneFrame::kPatient;
  std::optional<Volume> volume;  // in LPS: requires kPatient
  GreyWindow window;
  std::vector<SceneSurface> surfaces;  // in drawing order
  double dot_reach_mm = 0.5;           // points farther from a plane are not drawn in it
};

/// Robust centre and size of the finite vertices. Zero for empty sets.
struct Middle {
  Eigen::Vector3d median_mm = Eigen::Vector3d::Zero();  // per axis
  Eigen::Vector3d size_mm = Eigen::Vector3d::Zero();    // central 98 % per axis
};
Middle middleOf(const std::vector<SceneSurface>& surfaces);
/// Of all finite vertices; empty without any.
Eigen::AlignedBox3d boxOf(const std::vector<SceneSurface>& surfaces);
/// Outer faces of the voxels, in LPS.
Eigen::AlignedBox3d boxOf(const Volume& volume);

/// Colours distinguishable on CT, on white and with colour
/// blindness (Okabe and Ito); `index` of the surface in the figure.
Rgb8 surfaceColour(std::size_t index);
inline constexpr Rgb8 kScanRed{235, 30, 35};

/// Darker version for white paper.
Rgb8 onWhite(Rgb8 colour);

}  // namespace softscope
