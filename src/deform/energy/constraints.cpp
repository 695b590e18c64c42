#include "deform/energy/constraints.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/parallel.h"
#include "deform/graph/shape_memory.h"
#include "deform/graph/warp.h"

namespace softscope {
namespace {

bool usable(const PointModel& model, const WarpGraph& graph, int point) {
  const PointBinding& binding = model.bindings[point];
  return binding.bound() && binding.stencil < static_cast<int>(graph.stencils.size()) &&
         graph.stencils[static_cast<std::size_t>(binding.stencil)] != kOutsideStencil &&
         model.positions_mm[point].allFinite() && model.normals[point].allFinite();
}

/// Every `stride`-th usable point of `visible`, or of the model,
/// with its stencil: in parts, for sorting by several threads.
struct UsablePoints {
  std::vector<std::vector<std::pair<int, std::int32_t>>> parts;  // point, stencil; in order

  UsablePoints(const PointModel& model, const WarpGraph& graph, const std::vector<int>* visible,
               int stride) {
    const int points = static_cast<int>(model.size());
    const int all = visible ? static_cast<int>(visible->size()) : points;
    const int count = (all + stride - 1) / stride;
    parts.resize(static_cast<std::size_t>((count + kPointsPerTask - 1) / kPointsPerTask));
    parallelRanges(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
      for (int part = begin; part < end; ++part) {
        auto& own = parts[static_cast<std::size_t>(part)];
        own.reserve(kPointsPerTask);
        for (int k = part * kPointsPerTask; k < std::min(count, (part + 1) * kPointsPerTask); ++k) {
          const int point = visible ? (*visible)[k * stride] : k * stride;
          if (point >= 0 && point < points && usable(model, graph, point))
            own.emplace_back(point, model.bindings[point].stencil);
        }
      }
    });
  }
};

/// Stable counting sort by stencil; `start` has an entry per stencil and the end.
std::vector<int> sortedByStencil(const UsablePoints& points, std::vector<int>* start) {
  const std::size_t stencils = start->size() - 1;
  std::vector<std::vector<int>> next(points.parts.size());  // next position of every part
  const int parts = static_cast<int>(next.size());
  parallelRanges(parts, 1, [&](int begin, int end) {
    for (int part = begin; part < end; ++part) {
      next[part].assign(stencils, 0);
      for (const auto& [point, stencil] : points.parts[part]) ++next[part][stencil];
    }
  });
  int total = 0;
  for (std::size_t s = 0; s < stencils; ++s) {
    (*start)[s] = total;
    for (std::vector<int>& counts : next) total += std::exchange(counts[s], total);
  }
  start->back() = total;
  std::vector<int> sorted(static_cast<std::size_t>(total));
  parallelRanges(parts, 1, [&](int begin, int end) {
    for (int part = begin; part < end; ++part)
      for (const auto& [point, stencil] : points.parts[part]) sorted[next[part][stencil]++] = point;
  });
  return sorted;
}

PlaneConstraint makeRow(const PointBinding& binding, const Eigen::Vector3f& point_mm,
                        const Eigen::Vector3f& normal, const Eigen::Vector3f& target_mm,
                        float weight) {
  PlaneConstraint row;
  for (int c = 0; c < 3; ++c) {
    row.point[c] = point_mm[c];
    row.normal[c] = normal[c];
    row.target[c] = target_mm[c];
  }
  std::copy(binding.weights.begin(), binding.weights.end(), row.node_weights);
  row.weight = weight;
  return row;
}

bool usable(const PointModel& model, const WarpGraph& graph, const KeyPointMatch& match) {
  return match.model_point >= 0 && match.model_point < static_cast<int>(model.size()) &&
         usable(model, graph, match.model_point) && match.source_mm.allFinite() &&
         match.target_mm.allFinite() && match.sqrt_information.allFinite();
}

/// Node that carries most of a point.
std::int32_t strongestNode(const WarpGraph& graph, const PointBinding& binding) {
  const auto strongest = std::max_element(binding.weights.begin(), binding.weights.end());
  return graph
      .stencils[static_cast<std::size_t>(binding.stencil)][strongest - binding.weights.begin()];
}

/// Buffers of one thread for the targets of the candidates of one stencil.
struct Inquiry {
  std::vector<Eigen::Vector3f> warped_mm, warped_normals;
  std::vector<PlaneTarget> targets;

  void resize(std::size_t count) {
    warped_mm.resize(count);
    warped_normals.resize(count);
    targets.resize(count);
  }
};

/// One row per candidate of the stencil with a target; returns their number.
int fillRows(const CandidatePoints& candidates, int first, const std::vector<PlaneTarget>& targets,
             double data_weight, PlaneConstraint* rows) {
  int filled = 0;
  for (const PlaneTarget& target : targets) {
    const int i = first++;
    if (!(target.reliability > 0)) continue;
    const double weight = data_weight * candidates.points_each * target.reliability;
    rows[filled++] = makeRow(candidates.bindings[i], candidates.positions_mm[i], target.normal,
                             target.point_mm, static_cast<float>(weight));
  }
  return filled;
}

}  // namespace

Eigen::Matrix3f matchSqrtInformation(const Eigen::Vector3f& ray, double along_mm, double across_mm,
                                     double reference_mm) {
  const Eigen::Matrix3f along = ray * ray.transpose();
  return along * static_cast<float>(reference_mm / along_mm) +
         (Eigen::Matrix3f::Identity() - along) * static_cast<float>(reference_mm / across_mm);
}

void collectCandidates(const PointModel& model, const WarpGraph& graph,
                       const std::vector<int>* visible, int max_points,
                       CandidatePoints* candidates) {
  const std::size_t count = visible ? visible->size() : model.size();
  const std::size_t limit = static_cast<std::size_t>(max_points);
  const int stride =
      max_points > 0 && count > limit ? static_cast<int>((count + limit - 1) / limit) : 1;
  candidates->points_each = static_cast<float>(stride);
  std::vector<int>& start = candidates->stencil_start;
  start.assign(graph.stencils.size() + 1, 0);
  const std::vector<int> sorted =
      sortedByStencil(UsablePoints(model, graph, visible, stride), &start);
  candidates->positions_mm.resize(sorted.size());
  candidates->normals.resize(sorted.size());
  candidates->bindings.resize(sorted.size());
  parallelRanges(start.back(), 4096, [&](int begin, int end) {
    for (int at = begin; at < end; ++at) {
      const int point = sorted[at];
      candidates->positions_mm[at] = model.positions_mm[point];
      candidates->normals[at] = model.normals[point];
      candidates->bindings[at] = model.bindings[point];
    }
  });
}

CandidatePoints noCandidates(const WarpGraph& graph) {
  CandidatePoints none;
  none.stencil_start.assign(graph.stencils.size() + 1, 0);
  return none;
}

void toPlaces(std::vector<std::int32_t>* keys, std::vector<int>* start) {
  for (const std::int32_t key : *keys)
    if (key >= 0) ++(*start)[static_cast<std::size_t>(key)];
  int total = 0;
  for (int& first : *start) total += std::exchange(first, total);
  std::vector<int> next(*start);
  for (std::int32_t& key : *keys)
    if (key >= 0) key = next[static_cast<std::size_t>(key)]++;
}

CarriedMatches::CarriedMatches(const PointModel& model, const WarpGraph& graph,
                               const std::vector<KeyPointMatch>& given)
    : matches(given),
      place(matches.size(), PointBinding::kUnbound),
      node(place),
      start(graph.stencils.size() + 1, 0) {
  parallelRanges(static_cast<int>(matches.size()), kMatchesPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (!usable(model, graph, matches[i])) continue;
      const PointBinding& binding = model.bindings[matches[i].model_point];
      place[i] = binding.stencil;
      node[i] = strongestNode(graph, binding);
    }
  });
  toPlaces(&place, &start);
}

void countMatches(const CarriedMatches& carried, const WarpGraph& graph, ConstraintSet* set) {
  set->rows.clear();
  set->stencils.assign(graph.stencils.size(), StencilRows());
  for (std::size_t s = 0; s < set->stencils.size(); ++s)
    set->stencils[s].matches = carried.start[s + 1] - carried.start[s];
  set->matches = carried.count();
  set->matches_dropped = static_cast<int>(carried.place.size()) - carried.count();
  set->stiffness.assign(graph.edges.size(), 1);
  listActive(set);
}

void makeConstraints(const PointModel& model, const WarpGraph& graph,
                     const CandidatePoints& candidates, const CarriedMatches& carried,
                     double match_weight, ConstraintSet* set) {
  const std::vector<KeyPointMatch>& matches = carried.matches;
  countMatches(carried, graph, set);
  expectShape(graph, 0, &set->expected);
  for (std::size_t s = 0; s < set->stencils.size(); ++s)
    set->stencils[s].first = 3 * carried.start[s] + candidates.stencil_start[s];
  set->rows.resize(static_cast<std::size_t>(3 * carried.count() + candidates.stencil_start.back()));
  parallelRanges(static_cast<int>(matches.size()), kMatchesPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (carried.place[i] < 0) continue;
      const KeyPointMatch& match = matches[i];
      const PointBinding& binding = model.bindings[match.model_point];
      const int first_row = 3 * carried.place[i] + candidates.stencil_start[binding.stencil];
      for (int c = 0; c < 3; ++c)
        set->rows[first_row + c] =
            makeRow(binding, match.source_mm, match.sqrt_information.row(c).transpose(),
                    match.target_mm, static_cast<float>(match_weight));
    }
  });
}

void listActive(ConstraintSet* constraints) {
  constraints->active.clear();
  constraints->points = 0;
  for (std::size_t s = 0; s < constraints->stencils.size(); ++s) {
    if (constraints->stencils[s].rows() > 0) constraints->active.push_back(static_cast<int>(s));
    constraints->points += constraints->stencils[s].points;
  }
}

void associate(const WarpGraph& graph, const CandidatePoints& candidates,
               const SurfaceTarget* surface, double data_weight, ConstraintSet* constraints) {
  if (surface == nullptr || data_weight <= 0 || candidates.positions_mm.empty()) return;
  const std::vector<PackedNode> nodes = packNodes(graph);
  parallelRanges(static_cast<int>(graph.stencils.size()), 64, [&](int begin, int end) {
    Inquiry inquiry;
    for (int s = begin; s < end; ++s) {
      const int first = candidates.stencil_start[s];
      const int count = candidates.stencil_start[s + 1] - first;
      if (count == 0) continue;
      inquiry.resize(static_cast<std::size_t>(count));
      warpRange(nodes, graph.stencils, candidates.bindings.data() + first,
                candidates.positions_mm.data() + first, candidates.normals.data() + first, count,
                inquiry.warped_mm.data(), inquiry.warped_normals.data());
      surface->lookUp(inquiry.warped_mm.data(), inquiry.warped_normals.data(), count,
                      inquiry.targets.data());
      StencilRows& rows = constraints->stencils[s];
      rows.points = fillRows(candidates, first, inquiry.targets, data_weight,
                             constraints->rows.data() + rows.first + 3 * rows.matches);
    }
  });
  listActive(constraints);
}

}  // namespace softscope
