// vtk_views/scenes/four_panels.h: figure of axial,
// coronal, sagittal and 3-D panels, or of slices.
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

/// Options of a figure with panels.
struct PanelOptions {
  FigureStyle style;
  double width_mm = 0;        // field of view of each panel; 0: automatic, from its surfaces
  bool keep_centres = false;  // plane centres were requested; else centres of the surfaces
  int columns = 0;            // 0: as many as fit
  FigureFoot foot;            // an empty legend is taken from the scene
};

struct FourPanelOptions : PanelOptions {
  SideRule rule = SideRule::kRadiological;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();  // intersection of the three planes
  Eigen::Vector3d eye = {0.45, -0.8, 0.4};              // view direction of the 3-D panel
};

/// Three planes, the camera of the fourth panel, and the common field of view.
PanelField fourViews(const Scene& scene, const FourPanelOptions& options);
/// The same for slices through these planes.
PanelField sliceViews(const Scene& scene, const std::vector<ViewPlane>& planes,
                      const PanelOptions& options);

/// Three panels if no surface is drawn in 3-D. Throws BackendError without a renderer.
VectorDrawing drawFourPanels(const Scene& scene, const FourPanelOptions& options);

/// One panel per plane. Requires one.
VectorDrawing drawSlices(const Scene& scene, const std::vector<ViewPlane>& planes,
                         const PanelOptions& options);

/// 3-D view of the surfaces of a scene, as one of several panels.
struct ScenePanel {
  const Scene* scene = nullptr;
  ViewPlane camera;
  std::string caption;
  int world = 0;  // panels of the same world have the same centre
};

/// One panel per scene at a common scale; legend of the first scene. Requires one.
VectorDrawing drawScenes(const std::vector<ScenePanel>& panels, const PanelOptions& options);

/// Centre of the box of the surfaces;
/// median of the surfaces in focus, if any.
Eigen::Vector3d sceneCentre(const Scene& scene);
/// Field of view that contains the surfaces from any direction, with a margin.
double sceneWidthMm(const Scene& scene);

}  // namespace softscope
