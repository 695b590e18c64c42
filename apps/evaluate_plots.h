// apps/evaluate_plots.h: from what was judged to what is drawn.
#pragma once

#include <string>

#include "apps/evaluate_result.h"
#include "vtk_views/series_plot.h"

namespace softscope {

/// Of all judged models, over time, or over frames where no time is known. At least one model.
ErrorSeriesData seriesData(const EvaluationResult& result);

/// Of the pooled points, from 0 to a round number above the 99th percentile. At least one model.
ErrorHistogramData histogramData(const EvaluationResult& result);

}  // namespace softscope
