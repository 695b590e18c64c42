// vtk_views/scenes/error_map_figure.h: error maps side by side, with their colour bars.
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
  double limit_mm = 1;  // of the colours, common to all cells
  double font_pt = 7.5;
};

/// Each cell in the `look` direction of its map, in parallel projection, errors
/// unlit, the reference grey behind them; one bar for unsigned and one for
/// signed cells. Requires one cell. Throws BackendError without a renderer.
VectorDrawing drawErrorMaps(const std::vector<ErrorMapCell>& cells,
                            const ErrorMapFigureStyle& style);

}  // namespace softscope
