// vtk_views/scenes/panel_field.h: common centre and field of view of panels.
#pragma once

#include <vector>

#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Views of a figure at a common scale.
struct PanelField {
  std::vector<ViewPlane> planes;
  double width_mm = 0;  // field of view of each panel
};

/// View of a scene; several views may share a scene.
struct FieldView {
  const Scene* scene = nullptr;
  ViewPlane plane;
  bool is_3d = false;  // surfaces without in_3d are ignored
  int world = 0;       // scenes of different worlds have unrelated coordinates
};

/// Moves each plane centre, within the plane, to the centre of the projected box of the
/// surfaces, and computes the field of view in which no box is cut or covered by the side names.
/// Views of one world in one direction keep a common centre, so that motion remains visible. For
/// points, the central 99.8 % along each axis count. The field of view does not exceed the
/// volume. `panel_pt`: width of a panel on the page. With `keep_centres` centres are unchanged.
PanelField fitField(const std::vector<FieldView>& views, double panel_pt, const FigureStyle& style,
                    bool keep_centres);

/// Space at each side of a panel for side names and the scale bar, pt.
double sideRoomPt(const FigureStyle& style);

}  // namespace softscope
