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

/// A surface, or points where the mesh has no triangles.
struct SceneSurface {
  std::string name;  // as the legend has it; empty: not in the legend
  TriangleMesh mesh;
  Rgb8 colour{230, 159, 0};
  /// Measured elsewhere: empty, or one a vertex, mm; NaN = not observed.
  std::vector<double> errors_mm;
  double dot_scale = 1;   // of lines and points in slices, in widths of lines
  bool in_3d = true;      // drawn in 3-D panels too
  bool in_focus = false;  // the figure is about it: centre and size follow the surfaces marked so

  bool isPoints() const { return mesh.triangles.empty(); }
};

/// Everything in mm, in one frame.
struct Scene {
  SceneFrame frame = SceneFrame::kPatient;
  std::optional<Volume> volume;  // in LPS: for kPatient
  GreyWindow window;
  std::vector<SceneSurface> surfaces;  // later ones are drawn over earlier ones
  double dot_reach_mm = 0.5;           // points farther from a plane aren't drawn in it
};

/// Where most of the surfaces' finite vertices are, robust to outliers. Empty sets give zeros.
struct Middle {
  Eigen::Vector3d median_mm = Eigen::Vector3d::Zero();  // along each axis
  Eigen::Vector3d size_mm = Eigen::Vector3d::Zero();    // of the middle 98 % along each axis
};
Middle middleOf(const std::vector<SceneSurface>& surfaces);
/// Of all finite vertices; empty where there are none.
Eigen::AlignedBox3d boxOf(const std::vector<SceneSurface>& surfaces);
/// Of the voxels' outer faces, in LPS.
Eigen::AlignedBox3d boxOf(const Volume& volume);

/// Colours that are told apart on CT, on white and by the colour-blind (Okabe and Ito): `index`
/// counts the surfaces of a figure.
Rgb8 surfaceColour(std::size_t index);
inline constexpr Rgb8 kScanRed{235, 30, 35};

/// Darker: pale colours are hard to see on white paper.
Rgb8 onWhite(Rgb8 colour);

}  // namespace softscope
