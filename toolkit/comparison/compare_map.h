// toolkit/comparison/compare_map.h: error map of a comparison, for interactive views.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/comparison/compare_record.h"
#include "vtk_views/files/error_map.h"

namespace softscope {

/// The test with its errors, at most 60 000 vertices of its own, and beside it the reference with
/// at most 8000. Both in the reference's place.
ErrorMap comparisonMap(const ComparisonResult& result, const TriangleMesh& reference,
                       const TriangleMesh& test);

}  // namespace softscope
