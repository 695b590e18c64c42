// toolkit/evaluation/evaluate_plots.h: data of the plots of an evaluation.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/plots/series_plot.h"
#include "vtk_views/plots/worst_frames_plot.h"

namespace softscope {

/// Of all judged models, over time, or over frames where no time is known; a frame that was not
/// fused leaves a gap. At least one model.
ErrorSeriesData seriesData(const EvaluationResult& result);

/// Which frames were fused, over the same axis; of no frame where that is not known.
OutcomeStripData outcomeStrip(const EvaluationResult& result);

/// The ten models with the largest mean, worst first. At least one model.
WorstFramesData worstFramesData(const EvaluationResult& result);

/// From 0 to a round number above the 99th percentile. At least one value is a number.
ErrorHistogramData histogramOf(const std::vector<double>& errors_mm, const std::string& title);

/// The same bins as JSON, for reports; null where no value is a number.
FactSheet::Json histogramJson(const std::vector<double>& errors_mm);

/// "run against reference", by the last parts of their paths.
std::string comparisonTitle(const std::string& test, const std::string& reference);

}  // namespace softscope
