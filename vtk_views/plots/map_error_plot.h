// vtk_views/plots/map_error_plot.h: error image of a depth or disparity map.
#pragma once

#include <string>

#include "core/raster.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

struct MapErrorData {
  std::string title;    // above the map
  Raster<float> error;  // absolute; NaN: not measured, or no truth
  std::string label;    // of the colour bar, with the unit
};

/// Map of the width of the sheet, colour bar below; style.height_mm is ignored.
/// The bar ends at the 95th percentile, rounded up; an arrow marks larger errors.
VectorDrawing drawMapErrors(const MapErrorData& data, const PlotStyle& style = {});

}  // namespace softscope
