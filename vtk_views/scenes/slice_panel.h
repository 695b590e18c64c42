// vtk_views/scenes/slice_panel.h: slice of a scene as part of a figure.
#pragma once

#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Position of a panel on the page.
struct PanelPlace {
  PointPt top_left;
  double width_pt = 0, height_pt = 0;

  double right() const { return top_left.x_pt + width_pt; }
  double bottom() const { return top_left.y_pt + height_pt; }
  /// Page position of a point of the panel, in shares from its centre: x right, y up, -0.5 to 0.5.
  PointPt at(double x, double y) const {
    return {top_left.x_pt + (0.5 + x) * width_pt, top_left.y_pt + (0.5 - y) * height_pt};
  }
};

/// Slice of the volume, or white; contours of the surfaces as lines, points near the
/// plane as dots; letters of the four sides; a scale bar. `width_mm`: field of view.
void drawSlicePanel(const Scene& scene, const ViewPlane& plane, double width_mm,
                    const PanelPlace& place, const FigureStyle& style, VectorDrawing& drawing);

/// Parts of drawSlicePanel() common to other panels.
void drawSideNames(const ViewPlane& plane, SceneFrame frame, const PanelPlace& place, Rgb8 colour,
                   const FigureStyle& style, VectorDrawing& drawing);
void drawScaleBar(double width_mm, const PanelPlace& place, Rgb8 colour, const FigureStyle& style,
                  VectorDrawing& drawing);
void drawPanelFrame(const PanelPlace& place, VectorDrawing& drawing);

/// 1, 2 or 5 times a power of ten, about a quarter of `width_mm`.
double scaleBarLengthMm(double width_mm);

}  // namespace softscope
