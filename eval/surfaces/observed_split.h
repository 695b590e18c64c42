// eval/surfaces/observed_split.h: a comparison where only a part of the reference was seen.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/statistics/statistics.h"
#include "eval/surfaces/hausdorff.h"
#include "eval/surfaces/surface_comparison.h"

namespace softscope {

/// The reference counts as observed within `reach_mm` of what was seen, and not beyond its rim
/// where that is an open surface; a vertex of the test where its closest point on the reference is.
/// What lies beyond the rim of an open reference is neither observed nor predicted: it is unknown
/// the truth there, and its distance from the rim is no error.
struct ObservedSplit {
  double reach_mm = 0;
  double reference_share = Statistics::kNone;  // of the reference's vertices: observed
  double test_share = Statistics::kNone;       // of the test's vertices: observed
  double beyond_share = Statistics::kNone;     // of the test's vertices: beyond the reference's rim
  Statistics observed_mm;                      // of the test's observed vertices
  Statistics predicted_mm;                     // of its others: carried along, unseen
  Statistics completeness_mm;                  // of the observed reference's vertices
  /// Of the observed reference's vertices: farther than reach_mm from the test.
  double not_reconstructed_share = Statistics::kNone;
  HausdorffDistances hausdorff;             // of observed vertices, both ways
  std::vector<std::uint8_t> each_observed;  // one a vertex of the test; 0 beyond the rim too
};

/// `comparison`: of reference and test. `observed`: a surface, or points; all in one frame, mm.
/// Throws InputError where it is empty or broken, OptionError for a reach that isn't above 0.
ObservedSplit splitByObserved(const TriangleMesh& reference, const TriangleMesh& observed,
                              const SurfaceComparison& comparison, double reach_mm);

}  // namespace softscope
