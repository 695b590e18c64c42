// toolkit/comparison/compare_picture.h: image of the test surface coloured by its errors.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/comparison/compare_record.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "vtk_views/drawing/figure_style.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Initial view direction: onto the part of the reference near the
/// test, or, for a closed surface, from the front of the patient.
Eigen::Vector3d comparisonEye(const TriangleMesh& reference,
                              const std::vector<ClosestPoint>& closest);

/// Test surface (in the space of the reference) coloured by its distances,
/// over the reference in grey, from the side of its mean normal and from
/// the opposite side. Throws BackendError without a renderer.
VectorDrawing drawComparison(const ComparisonResult& result, const TriangleMesh& reference,
                             const TriangleMesh& test, const ErrorColourOptions& options,
                             const FigureStyle& style);

}  // namespace softscope
