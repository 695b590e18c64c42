// toolkit/report/report_plots.h: the plots of one case, from its record.
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

/// Which frames were fused, skipped, lost; of no frame where the record says nothing.
OutcomeStripData outcomeStrip(const CaseFrames& frames);

/// Error over the judged moments; none for a pair, a single moment, or a record without frames.
std::optional<CaptionedFigure> seriesFigure(const ReportCase& c);

/// How the distances are spread; none where the record has no histogram.
std::optional<CaptionedFigure> histogramFigure(const ReportCase& c);

}  // namespace softscope
