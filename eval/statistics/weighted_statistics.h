// eval/statistics/weighted_statistics.h: statistics where a value counts for more than one.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// As statistics(), each value counting `weights[i]` times, so that densely meshed parts of a
/// surface count no more than others. Percentile q is where q % of the weight lies below, linear
/// between the middles of neighbours in rank; `count` is still the number of values. NaNs and
/// values of no weight are left out. Throws InputError for unequal lengths or a negative weight.
Statistics weightedStatistics(const std::vector<double>& values,
                              const std::vector<double>& weights);

/// A third of the area of the triangles around each vertex, mm^2.
std::vector<double> vertexAreas_mm2(const TriangleMesh& mesh);

}  // namespace softscope
