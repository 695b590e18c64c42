// toolkit/report/report_plots.h: plots of one case from its record.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toolkit/report/report_case.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/outcome_strip.h"

namespace softscope {

using CaptionedFigure = std::pair<VectorDrawing, std::string>;

/// Fused, skipped and lost frames; empty if unknown.
OutcomeStripData outcomeStrip(const CaseFrames& frames);

/// Error over the evaluated frames; none for a pair, a single frame, or a record without frames.
std::optional<CaptionedFigure> seriesFigure(const ReportCase& c);

/// Histogram of distances; none without a histogram in the record.
std::optional<CaptionedFigure> histogramFigure(const ReportCase& c);

}  // namespace softscope
