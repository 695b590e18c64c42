// eval/statistics/weighted_statistics.h: statistics of weighted values.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// As statistics(), with a weight per value, so that the density of a mesh does not
/// affect the result. Percentile q: q % of the weight is below, linear between the
/// midpoints of neighbouring ranks; `count` is the number of values. Without NaNs
/// and zero weights. Throws InputError for different lengths or a negative weight.
Statistics weightedStatistics(const std::vector<double>& values,
                              const std::vector<double>& weights);

/// Per vertex a third of the area of its triangles, mm^2.
std::vector<double> vertexAreas_mm2(const TriangleMesh& mesh);

}  // namespace softscope
