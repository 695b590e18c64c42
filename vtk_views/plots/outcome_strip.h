// vtk_views/plots/outcome_strip.h: strip of fused, skipped and lost frames.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/plots/series_plot.h"

namespace softscope {

enum class FusionOutcome { kFused, kSkipped, kLost };

const char* toString(FusionOutcome outcome);

/// One cell per frame, in the order of `x`.
struct OutcomeStripData {
  std::vector<double> x;  // ascending: frame numbers, or seconds
  std::vector<FusionOutcome> outcomes;
};

/// Cells over the x axis of a plot with this style and the
/// same frames; the legend above names each state with its
/// count. Throws Error for different lengths or no frame.
VectorDrawing drawOutcomeStrip(const OutcomeStripData& data, const PlotStyle& style = {});

/// Strip above the plot; the plot only without frames.
VectorDrawing withOutcomeStrip(const OutcomeStripData& data, const VectorDrawing& plot,
                               const PlotStyle& style = {});

}  // namespace softscope
