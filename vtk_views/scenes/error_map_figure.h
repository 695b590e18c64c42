// vtk_views/scenes/error_map_figure.h: error maps side by side, with the bar that explains them.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

struct ErrorMapCell {
  std::string title;
  const ErrorMap* map = nullptr;  // not owned
  bool with_sign = false;
};

struct ErrorMapFigureStyle {
  double width_mm = 180;
  int columns = 2;
  double limit_mm = 1;  // of the colours, the same for all cells
  double font_pt = 7.5;
};

/// Each cell along its map's `look`, in parallel projection, errors unlit, the reference grey
/// behind them; one bar for unsigned cells, one for signed ones. At least one cell. Throws
/// BackendError where nothing on this machine renders.
VectorDrawing drawErrorMaps(const std::vector<ErrorMapCell>& cells,
                            const ErrorMapFigureStyle& style);

}  // namespace softscope
