#include "pipeline/model/active_region.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "deform/graph/warp.h"
#include "deform/solver/local_solver.h"

namespace softscope {
namespace {

// Shares of the image, on every side. Between them the view moves without a change.
constexpr double kInactiveFrom = 0.25, kActiveTo = 0.125;
constexpr double kMuch = 0.1;  // of the stencils
constexpr int kNodesPerTask = 512;

/// Points, and the stencils to which they are bound.
struct BoundPoints {
  PointModel* points;
  std::vector<NodeStencil>* stencils;
};

template <class Value>
void takeRows(const std::vector<int>& rows, const std::vector<Value>& from,
              std::vector<Value>* to) {
  const std::size_t first = to->size();
  to->resize(first + rows.size());
  parallelRanges(static_cast<int>(rows.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      (*to)[first + static_cast<std::size_t>(i)] = from[static_cast<std::size_t>(rows[i])];
  });
}

/// Appends these points.
void takePoints(const std::vector<int>& which, const PointModel& from, PointModel* to) {
  takeRows(which, from.positions_mm, &to->positions_mm);
  takeRows(which, from.normals, &to->normals);
  takeRows(which, from.colours, &to->colours);
  takeRows(which, from.anchors, &to->anchors);
  takeRows(which, from.weights, &to->weights);
  takeRows(which, from.bindings, &to->bindings);
}

/// The points from `first` on.
void renumberStencils(const std::vector<std::int32_t>& numbers, std::size_t first,
                      std::vector<PointBinding>* bindings) {
  parallelRanges(static_cast<int>(bindings->size() - first), kPointsPerTask,
                 [&](int begin, int end) {
                   for (int i = begin; i < end; ++i) {
                     PointBinding& binding = (*bindings)[first + static_cast<std::size_t>(i)];
                     if (binding.bound())
                       binding.stencil = numbers[static_cast<std::size_t>(binding.stencil)];
                   }
                 });
}

/// Moves the stencils marked to the end of others. Returns their new numbers, each in its list.
std::vector<std::int32_t> moveStencils(const std::vector<char>& moves,
                                       std::vector<NodeStencil>* from,
                                       std::vector<NodeStencil>* to) {
  std::vector<std::int32_t> numbers(from->size());
  std::size_t kept = 0;
  for (std::size_t s = 0; s < from->size(); ++s) {
    if (moves[s] != 0) {
      numbers[s] = static_cast<std::int32_t>(to->size());
      to->push_back((*from)[s]);
    } else {
      numbers[s] = static_cast<std::int32_t>(kept);
      (*from)[kept++] = (*from)[s];
    }
  }
  from->resize(kept);
  return numbers;
}

/// Moves the points of the stencils marked to the end of others. Returns the new numbers of those
/// that stay; they keep their order.
IndexMap move(const std::vector<char>& stencils, const BoundPoints& from, const BoundPoints& to) {
  const auto find = [&](bool moved) {
    return parallelFind(
        static_cast<int>(from.points->size()), kPointsPerTask,
        [&](int begin, int end, std::vector<int>* found) {
          for (int i = begin; i < end; ++i) {
            const PointBinding& binding = from.points->bindings[static_cast<std::size_t>(i)];
            const bool moves =
                binding.bound() && stencils[static_cast<std::size_t>(binding.stencil)] != 0;
            if (moves == moved) found->push_back(i);
          }
        });
  };
  const std::vector<int> moving = find(true), staying = find(false);
  IndexMap map;
  map.new_of_old.assign(from.points->size(), IndexMap::kRemoved);
  for (const int i : staying) map.new_of_old[static_cast<std::size_t>(i)] = map.new_count++;

  const std::vector<std::int32_t> numbers = moveStencils(stencils, from.stencils, to.stencils);
  const std::size_t before = to.points->size();
  takePoints(moving, *from.points, to.points);
  renumberStencils(numbers, before, &to.points->bindings);
  PointModel kept;
  takePoints(staying, *from.points, &kept);
  renumberStencils(numbers, 0, &kept.bindings);
  *from.points = std::move(kept);
  return map;
}

/// Motion of the nodes since the points were deactivated, as the warp of a graph.
WarpGraph motionSince(const InactivePoints& then, const WarpGraph& now,
                      std::vector<NodeStencil> stencils) {
  WarpGraph motion;
  motion.stencils = std::move(stencils);
  motion.positions_mm = then.nodes_mm;
  motion.transforms.resize(motion.size());
  for (std::size_t j = 0; j < motion.size(); ++j)
    motion.transforms[j] = {now.turned[j] * then.turned[j].transpose(),
                            now.positions_mm[j] - then.nodes_mm[j]};
  return motion;
}

void activateStencils(const std::vector<char>& stencils, ModelState* state) {
  PointModel points;
  std::vector<NodeStencil> of_points;
  move(stencils, {&state->inactive.points, &state->graph.inactive_stencils}, {&points, &of_points});
  warpModel(motionSince(state->inactive, state->graph, of_points), &points);
  const std::vector<char> all(of_points.size(), 1);
  move(all, {&points, &of_points}, {&state->model, &state->graph.stencils});
}

template <class IsTrue>
bool anyNode(const NodeStencil& stencil, const IsTrue& isTrue) {
  return std::any_of(stencil.begin(), stencil.end(), isTrue);
}

std::vector<char> withAnyNode(const std::vector<NodeStencil>& stencils,
                              const std::vector<char>& nodes) {
  std::vector<char> found;
  for (const NodeStencil& stencil : stencils)
    found.push_back(
        anyNode(stencil, [&](std::int32_t j) { return nodes[static_cast<std::size_t>(j)] != 0; }));
  return found;
}

}  // namespace

std::vector<char> ActiveRegion::nodesWithin(double share, const WarpGraph& graph) const {
  std::vector<char> within(graph.size());
  const auto isWithin = [&](const Eigen::Vector3d& node_mm) {
    Eigen::Vector3d at_mm = left_from_world_ * node_mm;
    if (at_mm.z() < -node_spacing_mm_) return false;
    at_mm.z() = std::max(at_mm.z(), node_spacing_mm_);
    const Eigen::Vector2d pixel = projectPoint(left_, at_mm);
    const double carried_px = left_.fx_px * node_spacing_mm_ / at_mm.z();
    const auto isBeside = [&](double at_px, int size_px) {
      const double more_px = share * size_px + carried_px;
      return at_px < -more_px || at_px > size_px + more_px;
    };
    return !isBeside(pixel.x(), left_.width_px) && !isBeside(pixel.y(), left_.height_px);
  };
  parallelRanges(static_cast<int>(graph.size()), kNodesPerTask, [&](int begin, int end) {
    for (std::size_t j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end); ++j)
      within[j] = isWithin(graph.positions_mm[j]);
  });
  return within;
}

bool ActiveRegion::reachesInactive(const ModelState& state) const {
  const WarpGraph& graph = state.graph;
  if (graph.inactive_stencils.empty()) return false;
  const std::vector<char> found =
      withAnyNode(graph.inactive_stencils, nodesWithin(kActiveTo, graph));
  return std::find(found.begin(), found.end(), 1) != found.end();
}

void ActiveRegion::activate(ModelState* state) const {
  activateStencils(
      withAnyNode(state->graph.inactive_stencils, nodesWithin(kInactiveFrom, state->graph)), state);
}

/// Per stencil of the active points.
std::vector<char> ActiveRegion::stencilsBeyond(const ModelState& state) const {
  const WarpGraph& graph = state.graph;
  std::vector<char> stays = nodesWithin(kInactiveFrom, graph);
  for (const MaterialPoints::Point& point : state.tracked.points) {
    if (point.model_point < 0) continue;
    const PointBinding& binding = state.model.bindings[static_cast<std::size_t>(point.model_point)];
    if (!binding.bound()) continue;
    for (const std::int32_t node : graph.stencils[static_cast<std::size_t>(binding.stencil)])
      stays[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<char> beyond = withAnyNode(graph.stencils, stays);
  for (char& stencil : beyond) stencil = stencil == 0;
  return beyond;
}

bool ActiveRegion::leavesMuch(const ModelState& state) const {
  if (state.graph.size() <= LocalRule::kWholeUpTo) return false;
  const std::vector<char> beyond = stencilsBeyond(state);
  return static_cast<double>(std::count(beyond.begin(), beyond.end(), 1)) >=
         kMuch * static_cast<double>(beyond.size());
}

IndexMap ActiveRegion::deactivate(ModelState* state) const {
  const std::vector<char> beyond = stencilsBeyond(*state);
  InactivePoints& inactive = state->inactive;
  WarpGraph& graph = state->graph;
  if (!inactive.points.empty())
    warpModel(motionSince(inactive, graph, graph.inactive_stencils), &inactive.points);
  inactive.nodes_mm = graph.positions_mm;
  inactive.turned = graph.turned;
  return move(beyond, {&state->model, &graph.stencils},
              {&inactive.points, &graph.inactive_stencils});
}

void activateAll(ModelState* state) {
  activateStencils(std::vector<char>(state->graph.inactive_stencils.size(), 1), state);
  state->inactive = {};
}

}  // namespace softscope
