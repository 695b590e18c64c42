// vtk_views/plots/worst_frames_plot.cpp: nested bars.
#include "vtk_views/plots/worst_frames_plot.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/plot_colours.h"

namespace softscope {
namespace {

void drawNumber(const PlotAxes& axes, double middle, int frame, double font_pt,
                VectorDrawing& drawing) {
  DrawnText number;
  number.at = {axes.xPt(middle), axes.bottom() + 1.4 * font_pt};
  number.text = std::to_string(frame);
  number.size_pt = font_pt;
  number.anchor = TextAnchor::kMiddle;
  drawing.parts.emplace_back(number);
}

}  // namespace

VectorDrawing drawWorstFrames(const WorstFramesData& data, const PlotStyle& style) {
  const std::size_t count = data.frames.size();
  if (count == 0 || data.mean.size() != count || data.p95.size() != count)
    throw Error("worst frames: at least one, and a mean and a P95 for each");
  double highest = 1e-6;
  for (const auto& values : {data.mean, data.p95})
    for (const double value : values)
      if (std::isfinite(value)) highest = std::max(highest, value);
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  const PlotAxes axes = plotAxes(drawing, {0.4, static_cast<double>(count) + 0.6},
                                 {0, 1.06 * highest}, style.font_pt, {});
  axes.drawGrid(drawing);
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = static_cast<double>(i) + 1;
    axes.drawBar(middle, 0.4, data.p95[i], kBarBlue, drawing);
    axes.drawBar(middle, 0.25, data.mean[i], kPlotBlue, drawing);
    drawNumber(axes, middle, data.frames[i], style.font_pt, drawing);
  }
  axes.drawFrame("frame, worst mean first", data.error_label, drawing, /*x_numbers=*/false);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  drawLegend({{"mean", kPlotBlue, true}, {"up to P95", kBarBlue, true}},
             {axes.left(), 2.5 * style.font_pt}, style.font_pt, drawing);
  return drawing;
}

}  // namespace softscope
