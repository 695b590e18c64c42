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

/// A key point of the model found again: docs/energy.md (12). World frame, mm.
struct KeyPointMatch {
  std::int32_t model_point = 0;  // a bound point at the source: its nodes carry the match
  Eigen::Vector3f source_mm;     // on the model, before the warp
  Eigen::Vector3f target_mm;     // where it was measured
  /// Whitens the residual; identity: reference sigma in every direction.
  Eigen::Matrix3f sqrt_information = Eigen::Matrix3f::Identity();
};

/// sqrt_information of a match whose target was measured along `ray` (unit, world frame) with
/// `along_mm`, and across it with `across_mm` of standard error; errors of reference_mm weigh 1.
Eigen::Matrix3f matchSqrtInformation(const Eigen::Vector3f& ray, double along_mm, double across_mm,
                                     double reference_mm);

/// Model points that the live surface may pull, sorted by stencil. Made once a frame.
struct CandidatePoints {
  std::vector<Eigen::Vector3f> positions_mm;  // before the warp
  std::vector<Eigen::Vector3f> normals;
  std::vector<PointBinding> bindings;
  std::vector<int> stencil_start;  // stencils + 1 entries
  float points_each = 1;           // how many model points each stands for
};

/// Keeps bound, finite points; of more than max_points (0 = no limit) an even subset.
/// `visible`: model points to choose from; nullptr = all. Renews *candidates, whose memory is
/// used again.
void collectCandidates(const PointModel& model, const WarpGraph& graph,
                       const std::vector<int>* visible, int max_points,
                       CandidatePoints* candidates);

/// None, for this graph.
CandidatePoints noCandidates(const WarpGraph& graph);

/// Rows of one stencil: three a match, then one a point that the surface pulls.
struct StencilRows {
  int first = 0;  // into ConstraintSet::rows
  int matches = 0;
  int points = 0;

  int rows() const { return 3 * matches + points; }
};

struct ConstraintSet {
  std::vector<PlaneConstraint> rows;  // with gaps between stencils
  std::vector<StencilRows> stencils;  // one a stencil of the graph
  std::vector<int> active;            // stencils that have rows
  int matches = 0;
  int matches_dropped = 0;  // not finite, or their model point unbound
  int points = 0;
  std::vector<double> stiffness;          // one an edge of the graph, 1 = as stiff as unseen tissue
  std::vector<ExpectedOffsets> expected;  // one an edge
  std::vector<double> hidden;  // one a node: the share of its points that is out of sight
};

/// Room for all candidates, and the matches' rows; all edges stiff. Renews *constraints, whose
/// memory is used again.
void makeConstraints(const PointModel& model, const WarpGraph& graph,
                     const CandidatePoints& candidates, const std::vector<KeyPointMatch>& matches,
                     double match_weight, ConstraintSet* constraints);

/// Counts rows and points anew.
void listActive(ConstraintSet* constraints);

/// Warps the candidates by the graph's transforms and takes from the surface (nullptr: none)
/// their targets; replaces the rows of points.
void associate(const WarpGraph& graph, const CandidatePoints& candidates,
               const SurfaceTarget* surface, double data_weight, ConstraintSet* constraints);

}  // namespace softscope
