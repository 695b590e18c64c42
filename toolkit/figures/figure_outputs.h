// toolkit/figures/figure_outputs.h: writer of a figure in each format, with a record.
#pragma once

#include <vector>

#include "toolkit/figures/figure_options.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// PNG, PDF or SVG, by the file extension of each --out; the record is written last.
void writeFigure(const VectorDrawing& drawing, const FigureOptions& options,
                 const FactSheet::Json& record);

/// Name, centre, right, up and orientation letters of a view.
FactSheet::Json viewJson(const ViewPlane& view, SceneFrame frame, double width_mm);

/// Common first part of the record of a figure.
FactSheet::Json figureRecord(const std::string& command, const FigureOptions& options);

}  // namespace softscope
