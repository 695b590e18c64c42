// eval/surfaces/observed_split.h: comparison with a partially observed reference.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"
#include "eval/surfaces/surface_comparison.h"

namespace softscope {

/// The reference is observed within `reach_mm` of the observed surface, and not beyond the
/// border of that surface if it is open; a vertex of the test is observed if its closest point
/// on the reference is. Vertices beyond the border of an open reference are neither observed
/// nor predicted: the truth is unknown there, and the distance to the border is not an error.
struct ObservedSplit {
  double reach_mm = 0;
  double reference_share = Statistics::kNone;  // share of reference vertices: observed
  double test_share = Statistics::kNone;       // share of test vertices: observed
  double beyond_share = Statistics::kNone;     // share of test vertices: beyond that border
  Statistics observed_mm;                      // observed test vertices
  Statistics predicted_mm;                     // other test vertices: invisible, moved by the warp
  Statistics completeness_mm;                  // observed reference vertices
  /// Share of the observed reference vertices farther than reach_mm from the test.
  double not_reconstructed_share = Statistics::kNone;
  HausdorffDistances hausdorff;             // observed vertices, both directions
  std::vector<std::uint8_t> each_observed;  // one per test vertex; 0 beyond the border
};

/// `comparison`: of reference and test. `observed`: a surface, or points; all in one frame, mm.
/// Throws InputError for an empty or invalid surface, OptionError for a reach that is not positive.
ObservedSplit splitByObserved(const TriangleMesh& reference, const TriangleMesh& observed,
                              const SurfaceComparison& comparison, double reach_mm);

}  // namespace softscope
