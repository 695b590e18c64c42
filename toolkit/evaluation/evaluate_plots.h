// toolkit/evaluation/evaluate_plots.h: data of the plots of an evaluation.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/evaluate_result.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/plots/series_plot.h"
#include "vtk_views/plots/worst_frames_plot.h"

namespace softscope {

/// All evaluated models over time, or over frames without timestamps;
/// a frame that was not fused is a gap. Requires one model.
ErrorSeriesData seriesData(const EvaluationResult& result);

/// Fused frames over the same axis; empty if unknown.
OutcomeStripData outcomeStrip(const EvaluationResult& result);

/// The ten models with the largest mean, in descending order. Requires one model.
WorstFramesData worstFramesData(const EvaluationResult& result);

/// From 0 to a round number above the 99th percentile. Requires one value that is not NaN.
ErrorHistogramData histogramOf(const std::vector<double>& errors_mm, const std::string& title);

/// The same bins as JSON, for reports; null if all values are NaN.
FactSheet::Json histogramJson(const std::vector<double>& errors_mm);

/// "run against reference", from the last parts of the paths.
std::string comparisonTitle(const std::string& test, const std::string& reference);

}  // namespace softscope
