// vtk_views/scenes/four_panels.h: axial, coronal, sagittal and 3-D in one figure; and single
// slices.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/scenes/panel_field.h"
#include "vtk_views/scenes/panel_grid.h"
#include "vtk_views/scenes/scene.h"

namespace softscope {

/// What a figure with panels needs besides its scene.
struct PanelOptions {
  FigureStyle style;
  double width_mm = 0;        // of tissue, that each panel shows; 0: as its surfaces need
  bool keep_centres = false;  // of the planes: they were asked for; else the surfaces' middles
  int columns = 0;            // 0: as many as there is room for
  FigureFoot foot;            // its legend is the scene's where empty
};

struct FourPanelOptions : PanelOptions {
  SideRule rule = SideRule::kRadiological;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();  // where the three planes meet
  Eigen::Vector3d eye = {0.45, -0.8, 0.4};              // side that the 3-D panel is seen from
};

/// The three planes and the camera of the fourth panel, and what all of them show.
PanelField fourViews(const Scene& scene, const FourPanelOptions& options);
/// The same of slices through these planes.
PanelField sliceViews(const Scene& scene, const std::vector<ViewPlane>& planes,
                      const PanelOptions& options);

/// Three panels where no surface is to be shown in 3-D. Throws BackendError where nothing renders.
VectorDrawing drawFourPanels(const Scene& scene, const FourPanelOptions& options);

/// A panel a plane. At least one.
VectorDrawing drawSlices(const Scene& scene, const std::vector<ViewPlane>& planes,
                         const PanelOptions& options);

/// The surfaces of a scene in 3-D, as one panel of several.
struct ScenePanel {
  const Scene* scene = nullptr;
  ViewPlane camera;
  std::string caption;
  int world = 0;  // panels of one world show one place
};

/// A panel each, all at one scale; the legend is the first scene's. At least one.
VectorDrawing drawScenes(const std::vector<ScenePanel>& panels, const PanelOptions& options);

/// The middle of the surfaces' box; the median of those that the figure is about, where any are
/// marked so.
Eigen::Vector3d sceneCentre(const Scene& scene);
/// What a view from anywhere shows so that they fit with some room around.
double sceneWidthMm(const Scene& scene);

}  // namespace softscope
