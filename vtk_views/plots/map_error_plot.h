// vtk_views/plots/map_error_plot.h: the errors of a depth or disparity map, pixel by pixel.
#pragma once

#include <string>

#include "core/raster.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

struct MapErrorData {
  std::string title;    // above the map
  Raster<float> error;  // magnitude; NaN: not measured, or no truth
  std::string label;    // of the colour bar, with the unit
};

/// The map as wide as the sheet, its colour bar below it; style.height_mm does not count. The bar
/// ends at the 95th percentile, rounded up; an arrow says that some errors are larger.
VectorDrawing drawMapErrors(const MapErrorData& data, const PlotStyle& style = {});

}  // namespace softscope
