// vtk_views/four_panels.h: axial, coronal, sagittal and 3-D in one figure.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vtk_views/figure_style.h"
#include "vtk_views/scene.h"
#include "vtk_views/vector_drawing.h"

namespace softscope {

struct FourPanelOptions {
  FigureStyle style;
  SideRule rule = SideRule::kRadiological;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();  // where the three planes meet
  double width_mm = 200;                                // of tissue, that each panel shows
  Eigen::Vector3d eye = {0.45, -0.8, 0.4};              // side that the 3-D panel is seen from
  int columns = 0;                                      // 0: two, or four where there is room
  std::optional<ErrorColours> colours;                  // with errors: their bar
  ColourBarText bar;
};

/// Throws BackendError where nothing renders.
VectorDrawing drawFourPanels(const Scene& scene, const FourPanelOptions& options);

/// The centre of the surfaces' box, and what a panel shows so that they fit with some room around.
Eigen::Vector3d sceneCentre(const Scene& scene);
double sceneWidthMm(const Scene& scene);

}  // namespace softscope
