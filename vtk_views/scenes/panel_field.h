// vtk_views/scenes/panel_field.h: centre and field of view of panels.
#pragma once

#include <vector>

#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Views of a figure, all at one scale.
struct PanelField {
  std::vector<ViewPlane> planes;
  double width_mm = 0;  // that each panel shows
};

/// One view of one scene; several may share a scene.
struct FieldView {
  const Scene* scene = nullptr;
  ViewPlane plane;
  bool is_3d = false;  // surfaces that aren't in 3-D panels don't count
  int world = 0;       // scenes of another world have no place in common with these
};

/// Moves each plane's centre, within the plane, to the middle of the surfaces' box as that view
/// projects it, and finds the width at which no box is cut and none reaches under the words at the
/// panel's sides. Views of one world in one direction keep one centre, so that a motion stays
/// visible. Of points the middle 99.8 % along each axis count. A volume is not asked for more than
/// it has. `panel_pt`: width of a panel on the page. With `keep_centres` no centre is moved.
PanelField fitField(const std::vector<FieldView>& views, double panel_pt, const FigureStyle& style,
                    bool keep_centres);

/// Room at each side of a panel for side names and the scale bar, pt.
double sideRoomPt(const FigureStyle& style);

}  // namespace softscope
