#include "vtk_views/plots/map_error_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/median.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/drawing/nice_ticks.h"

namespace softscope {
namespace {

constexpr double kMargin = 0.4;  // in units of the font size
constexpr double kBarShare = 0.8;

/// 95th percentile of the evaluated pixels, rounded up; 1 without any.
double limitOf(const Raster<float>& error) {
  std::vector<float> known;
  std::copy_if(error.values.begin(), error.values.end(), std::back_inserter(known),
               [](float value) { return std::isfinite(value); });
  if (known.empty()) return 1;
  const float limit = quantileOf(std::move(known), 0.95);
  return limit > 0 ? roundUp(limit) : 1;
}

}  // namespace

VectorDrawing drawMapErrors(const MapErrorData& data, const PlotStyle& style) {
  const ErrorColours colours{false, limitOf(data.error)};
  ColourBarText bar;
  bar.label = data.label;
  bar.missing = "not measured, or no truth";
  DrawnPicture map;
  map.picture = ColourImage(data.error.width_px, data.error.height_px);
  for (std::size_t i = 0; i < data.error.size(); ++i) {
    const float error = data.error.values[i];
    map.picture.values[i] = colours.colour(error);
    bar.any_above |= error > colours.limit_mm;
    bar.any_missing |= !std::isfinite(error);
  }
  VectorDrawing drawing;
  drawing.width_pt = style.width_mm * kPtPerMm;
  const double margin = kMargin * style.font_pt;
  DrawnText title;
  title.at = {margin, 1.3 * style.font_pt};
  title.text = data.title;
  title.size_pt = style.font_pt;
  title.bold = true;
  drawing.parts.emplace_back(title);
  const double top = 1.9 * style.font_pt;
  const double height = drawing.width_pt * data.error.height_px / std::max(1, data.error.width_px);
  map.top_left = {0, top};
  map.bottom_right = {drawing.width_pt, top + height};
  drawing.parts.emplace_back(std::move(map));
  const double bar_width = kBarShare * drawing.width_pt;
  const double used =
      drawColourBar(colours, bar, {(drawing.width_pt - bar_width) / 2, top + height + 2 * margin},
                    bar_width, style.font_pt, drawing);
  drawing.height_pt = top + height + 3 * margin + used;
  return drawing;
}

}  // namespace softscope
