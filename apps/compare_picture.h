// apps/compare_picture.h: where the test lies off the reference, as a picture.
#pragma once

#include "apps/compare_record.h"
#include "apps/surface_error_map.h"
#include "core/triangle_mesh.h"
#include "vtk_views/figure_style.h"
#include "vtk_views/vector_drawing.h"

namespace softscope {

/// The test, in the reference's place, coloured by its distances, over the reference in grey: seen
/// from the side that most of it faces, and from the other. Throws BackendError where nothing
/// renders.
VectorDrawing drawComparison(const ComparisonResult& result, const TriangleMesh& reference,
                             const TriangleMesh& test, const ErrorColourOptions& options,
                             const FigureStyle& style);

}  // namespace softscope
