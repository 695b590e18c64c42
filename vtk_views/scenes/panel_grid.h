// vtk_views/scenes/panel_grid.h: panels side by side, captions below them, legend and bar at the
// foot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/slice_panel.h"

namespace softscope {

/// What stands below all panels.
struct FigureFoot {
  std::vector<LegendEntry> legend;
  std::optional<ErrorColours> colours;  // their bar
  ColourBarText bar;
  std::vector<std::string> notes;  // a small line each
};

/// Square panels, row by row.
struct PanelGrid {
  double width_pt = 0, height_pt = 0;
  std::vector<PanelPlace> panels;
  double foot_pt = 0;  // where the foot begins
};

/// `columns` 0: two, or up to four where the figure is wide enough. Throws OptionError where panels
/// would get narrower than a centimetre.
PanelGrid layOutPanels(std::size_t count, int columns, const FigureStyle& style,
                       const FigureFoot& foot);

/// An empty sheet of the grid's size.
VectorDrawing newSheet(const PanelGrid& grid);

/// "(b) coronal, P 12.0 mm".
void drawCaption(std::size_t index, const std::string& text, const PanelPlace& place,
                 const FigureStyle& style, VectorDrawing& drawing);

void drawFoot(const FigureFoot& foot, const PanelGrid& grid, const FigureStyle& style,
              VectorDrawing& drawing);

/// The scene's surfaces that have a name.
std::vector<LegendEntry> legendOf(const Scene& scene);

}  // namespace softscope
