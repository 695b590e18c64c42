// eval/surfaces/surface_comparison.h: a model against a reference surface, both ways.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"

namespace softscope {

/// Distances of one set's vertices from the other set.
struct DirectedErrors {
  std::vector<double> each_mm;  // one a vertex
  Statistics vertices_mm;       // each vertex counts the same
  Statistics area_mm;           // by area; NaN for a set of points
};

/// At one threshold, strictly nearer counts.
struct ThresholdScores {
  double tau_mm = 0;
  double precision = Statistics::kNone;     // share of the test's vertices
  double recall = Statistics::kNone;        // share of the reference's vertices
  double f_score = Statistics::kNone;       // their harmonic mean
  double surface_dice = Statistics::kNone;  // area within, both ways, over both areas
};

struct SurfaceComparison {
  DirectedErrors accuracy;            // the test from the reference's triangles
  DirectedErrors completeness;        // the reference from the test's triangles, or its points
  std::vector<ClosestPoint> closest;  // on the reference, one a vertex of the test
  Statistics signed_mm;               // of the test, positive = outside the reference
  HausdorffDistances hausdorff;       // of vertices, both ways
  std::vector<ThresholdScores> scores;
};

/// `test` may have no triangles: then it is a set of points. Both in one frame, mm. Throws
/// InputError where a set is empty or broken, OptionError for a threshold that isn't above 0.
SurfaceComparison compareSurfaces(const TriangleMesh& reference, const TriangleMesh& test,
                                  const std::vector<double>& taus_mm);

}  // namespace softscope
