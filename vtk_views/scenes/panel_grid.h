// vtk_views/scenes/panel_grid.h: grid of
// panels with captions, legend and colour bar.
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

/// Common part below all panels.
struct FigureFoot {
  std::vector<LegendEntry> legend;
  std::optional<ErrorColours> colours;  // with their colour bar
  ColourBarText bar;
  std::vector<std::string> notes;  // one small line per note
};

/// Square panels, row by row.
struct PanelGrid {
  double width_pt = 0, height_pt = 0;
  std::vector<PanelPlace> panels;
  double foot_pt = 0;  // top of the foot
};

/// `columns` 0: two, or up to four for a wide figure. Throws
/// OptionError for panels narrower than a centimetre.
PanelGrid layOutPanels(std::size_t count, int columns, const FigureStyle& style,
                       const FigureFoot& foot);

/// Empty sheet of the size of the grid.
VectorDrawing newSheet(const PanelGrid& grid);

/// "(b) coronal, P 12.0 mm".
void drawCaption(std::size_t index, const std::string& text, const PanelPlace& place,
                 const FigureStyle& style, VectorDrawing& drawing);

void drawFoot(const FigureFoot& foot, const PanelGrid& grid, const FigureStyle& style,
              VectorDrawing& drawing);

/// Surfaces of the scene with a name.
std::vector<LegendEntry> legendOf(const Scene& scene);

}  // namespace softscope
