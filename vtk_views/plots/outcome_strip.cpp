// vtk_views/plots/outcome_strip.cpp: one shape per run of equal states.
#include "vtk_views/plots/outcome_strip.h"

#include <algorithm>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"

namespace softscope {
namespace {

/// From pale to dark, distinguishable in grey.
Rgb8 colourOf(FusionOutcome outcome) {
  switch (outcome) {
    case FusionOutcome::kFused:
      return {190, 215, 228};
    case FusionOutcome::kSkipped:
      return {230, 159, 0};
    case FusionOutcome::kLost:
      return {140, 30, 30};
  }
  return {};
}

/// Midpoint to the previous neighbour; symmetric at the ends.
double borderBefore(const std::vector<double>& x, std::size_t i) {
  if (x.size() == 1) return i == 0 ? x[0] - 0.5 : x[0] + 0.5;
  if (i == 0) return x[0] - (x[1] - x[0]) / 2;
  if (i == x.size()) return x[i - 1] + (x[i - 1] - x[i - 2]) / 2;
  return (x[i - 1] + x[i]) / 2;
}

std::vector<LegendEntry> legendOf(const OutcomeStripData& data) {
  std::vector<LegendEntry> entries;
  for (const FusionOutcome outcome :
       {FusionOutcome::kFused, FusionOutcome::kSkipped, FusionOutcome::kLost}) {
    const auto count = std::count(data.outcomes.begin(), data.outcomes.end(), outcome);
    entries.push_back(
        {std::to_string(count) + " " + toString(outcome), colourOf(outcome), /*filled=*/true});
  }
  entries.front().meaning += " of " + std::to_string(data.x.size()) + " frames";
  return entries;
}

}  // namespace

const char* toString(FusionOutcome outcome) {
  switch (outcome) {
    case FusionOutcome::kFused:
      return "fused";
    case FusionOutcome::kSkipped:
      return "skipped";
    case FusionOutcome::kLost:
      return "lost";
  }
  return "lost";
}

VectorDrawing drawOutcomeStrip(const OutcomeStripData& data, const PlotStyle& style) {
  if (data.x.empty() || data.x.size() != data.outcomes.size())
    throw Error("outcome strip: it needs frames, and one outcome per frame");
  VectorDrawing drawing = newPlotSheet(style.width_mm, 1);
  drawing.height_pt = 3.2 * style.font_pt;
  const PlotAxes whole =
      plotAxes(drawing, AxisRange::around(data.x.front(), data.x.back()), {}, style.font_pt, {});
  const double top = 2.0 * style.font_pt, bottom = drawing.height_pt;
  for (std::size_t begin = 0, i = 1; i <= data.x.size(); ++i) {
    if (i < data.x.size() && data.outcomes[i] == data.outcomes[begin]) continue;
    const double from = whole.xPt(borderBefore(data.x, begin));
    const double to = whole.xPt(borderBefore(data.x, i));
    drawing.parts.emplace_back(DrawnShape{{{from, top}, {to, top}, {to, bottom}, {from, bottom}},
                                          colourOf(data.outcomes[begin])});
    begin = i;
  }
  drawLegend(legendOf(data), {whole.left(), style.font_pt}, style.font_pt, drawing);
  return drawing;
}

VectorDrawing withOutcomeStrip(const OutcomeStripData& data, const VectorDrawing& plot,
                               const PlotStyle& style) {
  if (data.x.empty()) return plot;
  VectorDrawing drawing = drawOutcomeStrip(data, style);
  appendBelow(plot, 0.4 * style.font_pt, drawing);
  return drawing;
}

}  // namespace softscope
