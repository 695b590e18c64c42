// toolkit/comparison/compare_picture.h: image of the test surface coloured by its errors.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/comparison/compare_record.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// From where a comparison is best looked at: before the part of the reference near the test, or,
/// of a surface all around, before a patient.
Eigen::Vector3d comparisonEye(const TriangleMesh& reference,
                              const std::vector<ClosestPoint>& closest);

/// The test, in the reference's place, coloured by its distances, over the reference in grey: seen
/// from the side that most of it faces, and from the other. Throws BackendError where nothing
/// renders.
VectorDrawing drawComparison(const ComparisonResult& result, const TriangleMesh& reference,
                             const TriangleMesh& test, const ErrorColourOptions& options,
                             const FigureStyle& style);

}  // namespace softscope
