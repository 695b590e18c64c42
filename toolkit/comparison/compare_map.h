// toolkit/comparison/compare_map.h: error map of a comparison, for interactive views.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/comparison/compare_record.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

/// Test surface with its errors (at most 60 000 vertices) and the
/// reference (at most 8000), both in the space of the reference.
ErrorMap comparisonMap(const ComparisonResult& result, const TriangleMesh& reference,
                       const TriangleMesh& test);

}  // namespace softscope
