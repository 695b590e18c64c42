// eval/surfaces/surface_comparison.h: comparison of a model with a reference surface.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"

namespace softscope {

/// Distances of the vertices of one set to the other set.
struct DirectedErrors {
  std::vector<double> each_mm;  // one per vertex
  Statistics vertices_mm;       // equal weight per vertex
  Statistics area_mm;           // weighted by area; NaN for a point set
};

/// At one threshold, strict (<).
struct ThresholdScores {
  double tau_mm = 0;
  double precision = Statistics::kNone;     // share of the test vertices
  double recall = Statistics::kNone;        // share of the reference vertices
  double f_score = Statistics::kNone;       // their harmonic mean
  double surface_dice = Statistics::kNone;  // area within, both directions, over both areas
};

struct SurfaceComparison {
  DirectedErrors accuracy;            // test to the triangles of the reference
  DirectedErrors completeness;        // reference to the triangles, or points, of the test
  std::vector<ClosestPoint> closest;  // on the reference, one per test vertex
  Statistics signed_mm;               // of the test, positive = outside of the reference
  HausdorffDistances hausdorff;       // of vertices, both directions
  std::vector<ThresholdScores> scores;
};

/// `test` without triangles is a point set. Both in one frame, mm. Throws InputError
/// for an empty or invalid set, OptionError for a threshold that is not positive.
SurfaceComparison compareSurfaces(const TriangleMesh& reference, const TriangleMesh& test,
                                  const std::vector<double>& taus_mm);

}  // namespace softscope
