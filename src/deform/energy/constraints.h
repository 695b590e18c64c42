// src/deform/energy/constraints.h: point and match constraints of one frame, sorted by stencil.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/surface_target.h"
#include "deform/kernels/deform_kernels.h"
#include "deform/kernels/edge_system.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Matched key point of the model: docs/energy.md (12). World frame, mm.
struct KeyPointMatch {
  std::int32_t model_point = 0;  // bound point at the source: its nodes carry the match
  Eigen::Vector3f source_mm;     // on the model, before the warp
  Eigen::Vector3f target_mm;     // measured position
  /// Whitens the residual; identity: reference sigma in every direction.
  Eigen::Matrix3f sqrt_information = Eigen::Matrix3f::Identity();
};

/// Grain of loops over matches.
inline constexpr int kMatchesPerTask = 512;

/// sqrt_information of a match whose target has the standard error `along_mm` along `ray`
/// (unit, world frame) and `across_mm` across it; errors of reference_mm have weight 1.
Eigen::Matrix3f matchSqrtInformation(const Eigen::Vector3f& ray, double along_mm, double across_mm,
                                     double reference_mm);

/// Model points for the data term, sorted by stencil. Computed once per frame.
struct CandidatePoints {
  std::vector<Eigen::Vector3f> positions_mm;  // before the warp
  std::vector<Eigen::Vector3f> normals;
  std::vector<PointBinding> bindings;
  std::vector<int> stencil_start;  // model points per candidate
  float points_each = 1;           // number of model points represented by each
};

/// Keeps bound, finite points; of more than max_points (0 = no
/// limit) an even subset. `visible`: candidate model points;
/// nullptr = all. Overwrites *candidates and reuses its memory.
void collectCandidates(const PointModel& model, const WarpGraph& graph,
                       const std::vector<int>* visible, int max_points,
                       CandidatePoints* candidates);

/// Empty, for this graph.
CandidatePoints noCandidates(const WarpGraph& graph);

/// Counting sort: replaces each key by its place in the order of the keys, as given within each;
/// negative ones stay. `start` has a 0 per key and one more, and becomes the first place of each,
/// and the end.
void toPlaces(std::vector<std::int32_t>* keys, std::vector<int>* start);

/// Matches in the order of the stencils that carry them, and as given within each.
struct CarriedMatches {
  CarriedMatches(const PointModel& model, const WarpGraph& graph,
                 const std::vector<KeyPointMatch>& matches);

  int count() const { return start.back(); }

  const std::vector<KeyPointMatch>& matches;
  std::vector<std::int32_t> place;  // of each match; negative: not finite, or of an unbound point
  std::vector<std::int32_t> node;   // that carries most of each match; negative likewise
  std::vector<int> start;           // places; one per stencil of the graph, and the end
};

/// Rows of one stencil: three per match, then one per point with a target.
struct StencilRows {
  int first = 0;  // into ConstraintSet::rows
  int matches = 0;
  int points = 0;

  int rows() const { return 3 * matches + points; }
};

struct ConstraintSet {
  std::vector<PlaneConstraint> rows;  // with gaps between stencils
  std::vector<StencilRows> stencils;  // one per stencil of the graph
  std::vector<int> active;            // stencils with rows
  int matches = 0;
  int matches_dropped = 0;  // not finite, or with an unbound model point
  int points = 0;
  std::vector<double> stiffness;          // one per graph edge, 1 = as stiff as unseen tissue
  std::vector<ExpectedOffsets> expected;  // one per edge
  std::vector<double> hidden;             // one per node: invisible share of its points
};

/// Counts the matches of every stencil, without any row; all edges stiff, of no expected shape yet.
/// Overwrites *constraints and reuses its memory.
void countMatches(const CarriedMatches& carried, const WarpGraph& graph,
                  ConstraintSet* constraints);

/// Allocates rows for all candidates, and the rows of matches; all
/// edges stiff. Overwrites *constraints and reuses its memory.
void makeConstraints(const PointModel& model, const WarpGraph& graph,
                     const CandidatePoints& candidates, const CarriedMatches& carried,
                     double match_weight, ConstraintSet* constraints);

/// Counts rows and points again.
void listActive(ConstraintSet* constraints);

/// Warps the candidates by the transforms of the graph and looks up their
/// targets on the surface (nullptr: none); replaces the rows of points.
void associate(const WarpGraph& graph, const CandidatePoints& candidates,
               const SurfaceTarget* surface, double data_weight, ConstraintSet* constraints);

}  // namespace softscope
