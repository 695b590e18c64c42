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
  std::vector<double> x;  // rising: frame numbers, or seconds
  std::vector<FusionOutcome> outcomes;
};

/// Cells over the same x axis as a plot of this style that spans the same frames; the legend above
/// them names each outcome with its count. Throws Error where the lengths differ or there is no
/// frame.
VectorDrawing drawOutcomeStrip(const OutcomeStripData& data, const PlotStyle& style = {});

/// The strip over the plot; the plot alone where there is no frame.
VectorDrawing withOutcomeStrip(const OutcomeStripData& data, const VectorDrawing& plot,
                               const PlotStyle& style = {});

}  // namespace softscope
