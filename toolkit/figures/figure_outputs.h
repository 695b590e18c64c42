// toolkit/figures/figure_outputs.h: writing of a figure in each format, with a record.
#pragma once

#include <vector>

#include "toolkit/figures/figure_options.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// As PNG, PDF or SVG, by the ending of each --out; the record last.
void writeFigure(const VectorDrawing& drawing, const FigureOptions& options,
                 const FactSheet::Json& record);

/// Name, centre, right, up and letters of a view.
FactSheet::Json viewJson(const ViewPlane& view, SceneFrame frame, double width_mm);

/// What every figure's record begins with.
FactSheet::Json figureRecord(const std::string& command, const FigureOptions& options);

}  // namespace softscope
