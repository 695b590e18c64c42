#include "pipeline/model/active_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/parallel.h"
#include "core/parallel_copy.h"
#include "deform/graph/node_pairs.h"
#include "deform/graph/warp.h"
#include "deform/solver/local_solver.h"

namespace softscope {
namespace {

// Shares of the image, on every side. Between them the view moves without a change.
constexpr double kInactiveFrom = 0.25, kActiveTo = 0.125;
constexpr double kMuch = 0.1;         // of the stencils
constexpr double kBlockSpacings = 2;  // of nodes, along the side of a block of inactive points
constexpr int kNodesPerTask = 512;

bool holdsAny(const std::vector<std::int32_t>& nodes, const std::vector<char>& marked) {
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](std::int32_t j) { return marked[static_cast<std::size_t>(j)] != 0; });
}

template <class Value>
std::vector<Value> rowsOf(const std::vector<int>& rows, const std::vector<Value>& from) {
  std::vector<Value> taken(rows.size());
  parallelRanges(static_cast<int>(rows.size()), kPointsPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      taken[i] = from[static_cast<std::size_t>(rows[i])];
  });
  return taken;
}

PointModel pointsOf(const std::vector<int>& which, const PointModel& from) {
  return {rowsOf(which, from.positions_mm), rowsOf(which, from.normals),
          rowsOf(which, from.colours),      rowsOf(which, from.anchors),
          rowsOf(which, from.weights),      rowsOf(which, from.bindings)};
}

/// To a model that has room for them from `first` on, in which their stencils have those numbers
/// from `first_stencil` on.
void putPoints(const PointModel& points, std::size_t first, std::int32_t first_stencil,
               PointModel* model) {
  const auto put = [&](const auto& from, auto* to) {
    std::copy(from.begin(), from.end(), to->begin() + static_cast<std::ptrdiff_t>(first));
  };
  put(points.positions_mm, &model->positions_mm);
  put(points.normals, &model->normals);
  put(points.colours, &model->colours);
  put(points.anchors, &model->anchors);
  put(points.weights, &model->weights);
  put(points.bindings, &model->bindings);
  for (std::size_t i = first; i < first + points.size(); ++i)
    model->bindings[i].stencil += first_stencil;
}

void resize(std::size_t count, PointModel* model) {
  model->positions_mm.resize(count);
  model->normals.resize(count);
  model->colours.resize(count);
  model->anchors.resize(count);
  model->weights.resize(count);
  model->bindings.resize(count);
}

/// Warps the points by the motion of their nodes since they became inactive.
void carry(const WarpGraph& now, InactivePoints* inactive) {
  WarpGraph motion;
  motion.stencils = inactive->stencils;
  motion.positions_mm = inactive->nodes_mm;
  for (std::size_t k = 0; k < inactive->nodes.size(); ++k) {
    const std::size_t j = static_cast<std::size_t>(inactive->nodes[k]);
    motion.transforms.push_back({now.turned[j] * inactive->turned[k].transpose(),
                                 now.positions_mm[j] - inactive->nodes_mm[k]});
  }
  warpModel(motion, &inactive->points);
}

/// With nodes of the graph.
NodeStencil wholeStencil(const InactivePoints& inactive, NodeStencil stencil) {
  for (std::int32_t& node : stencil) node = inactive.nodes[static_cast<std::size_t>(node)];
  return stencil;
}

/// Nodes that inactive points share keep their edges.
void connectInactive(ModelState* state) {
  NodePairs& pairs = state->graph.inactive_pairs;
  pairs.clear();
  for (const InactivePoints& inactive : state->inactive)
    pairs.insert(pairs.end(), inactive.pairs.begin(), inactive.pairs.end());
  sortNodePairs(static_cast<int>(state->graph.size()), &pairs);
}

void append(std::vector<InactivePoints> blocks, ModelState* state) {
  struct Place {
    std::size_t point;
    std::int32_t stencil;
  };
  std::vector<NodeStencil>& stencils = state->graph.stencils;
  std::size_t points = state->model.size();
  std::vector<Place> places;
  for (const InactivePoints& block : blocks) {
    places.push_back({points, static_cast<std::int32_t>(stencils.size())});
    points += block.points.size();
    for (const NodeStencil& stencil : block.stencils)
      stencils.push_back(wholeStencil(block, stencil));
  }
  resize(points, &state->model);
  parallelRanges(static_cast<int>(blocks.size()), 1, [&](int begin, int end) {
    for (std::size_t b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end); ++b) {
      carry(state->graph, &blocks[b]);
      putPoints(blocks[b].points, places[b].point, places[b].stencil, &state->model);
    }
  });
}

/// Distributes stencils to blocks of neighbours.
class Blocks {
 public:
  explicit Blocks(double side_mm) : side_mm_(side_mm) {}

  /// Per stencil: its block and its number there; -1 for those that don't move.
  struct Place {
    int block = -1;
    std::int32_t stencil = -1;
  };
  std::vector<Place> place(const std::vector<char>& moves, const WarpGraph& graph) {
    std::vector<Place> places(moves.size());
    for (std::size_t s = 0; s < moves.size(); ++s) {
      if (moves[s] == 0) continue;
      const NodeStencil& stencil = graph.stencils[s];
      const int block = blockAt(graph.positions_mm[static_cast<std::size_t>(stencil.front())]);
      InactivePoints& of_block = all[static_cast<std::size_t>(block)];
      places[s] = {block, static_cast<std::int32_t>(of_block.stencils.size())};
      of_block.stencils.push_back(stencil);
    }
    for (InactivePoints& block : all) takeNodes(graph, &block);
    return places;
  }

  std::vector<InactivePoints> all;

 private:
  int blockAt(const Eigen::Vector3d& at_mm) {
    const auto cell = [&](double along_mm) {
      return static_cast<std::int64_t>(std::floor(along_mm / side_mm_));
    };
    const std::array<std::int64_t, 3> key{cell(at_mm.x()), cell(at_mm.y()), cell(at_mm.z())};
    const auto [at, is_new] = known_.emplace(key, static_cast<int>(all.size()));
    if (is_new) all.emplace_back();
    return at->second;
  }
  /// And their pairs. Then the stencils are of places in `nodes`.
  static void takeNodes(const WarpGraph& graph, InactivePoints* block) {
    std::vector<std::int32_t>& nodes = block->nodes;
    for (const NodeStencil& stencil : block->stencils)
      nodes.insert(nodes.end(), stencil.begin(), stencil.end());
    visitNodePairs(block->stencils,
                   [&](std::int32_t a, std::int32_t b) { block->pairs.emplace_back(a, b); });
    std::sort(block->pairs.begin(), block->pairs.end());
    block->pairs.erase(std::unique(block->pairs.begin(), block->pairs.end()), block->pairs.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (NodeStencil& stencil : block->stencils)
      for (std::int32_t& node : stencil)
        node = static_cast<std::int32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) -
                                         nodes.begin());
    for (const std::int32_t node : nodes) {
      block->nodes_mm.push_back(graph.positions_mm[static_cast<std::size_t>(node)]);
      block->turned.push_back(graph.turned[static_cast<std::size_t>(node)]);
    }
  }

  double side_mm_;
  std::map<std::array<std::int64_t, 3>, int> known_;
};

/// Drops the stencils marked; returns the new numbers of the others.
std::vector<std::int32_t> dropStencils(const std::vector<char>& drops,
                                       std::vector<NodeStencil>* stencils) {
  std::vector<std::int32_t> numbers(stencils->size(), -1);
  std::int32_t kept = 0;
  for (std::size_t s = 0; s < stencils->size(); ++s) {
    if (drops[s] != 0) continue;
    (*stencils)[static_cast<std::size_t>(kept)] = (*stencils)[s];
    numbers[s] = kept++;
  }
  stencils->resize(static_cast<std::size_t>(kept));
  return numbers;
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
  if (state.inactive.empty()) return false;
  const std::vector<char> near = nodesWithin(kActiveTo, state.graph);
  return std::any_of(state.inactive.begin(), state.inactive.end(),
                     [&](const InactivePoints& block) { return holdsAny(block.nodes, near); });
}

void ActiveRegion::activate(ModelState* state) const {
  const std::vector<char> near = nodesWithin(kInactiveFrom, state->graph);
  const auto first = std::stable_partition(
      state->inactive.begin(), state->inactive.end(),
      [&](const InactivePoints& block) { return !holdsAny(block.nodes, near); });
  append({std::make_move_iterator(first), std::make_move_iterator(state->inactive.end())}, state);
  state->inactive.erase(first, state->inactive.end());
  connectInactive(state);
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
  std::vector<char> beyond;
  for (const NodeStencil& stencil : graph.stencils)
    beyond.push_back(std::none_of(stencil.begin(), stencil.end(), [&](std::int32_t j) {
      return stays[static_cast<std::size_t>(j)] != 0;
    }));
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
  Blocks blocks(kBlockSpacings * node_spacing_mm_);
  const std::vector<Blocks::Place> places = blocks.place(beyond, state->graph);
  const std::vector<std::int32_t> numbers = dropStencils(beyond, &state->graph.stencils);

  IndexMap map;
  map.new_of_old.assign(state->model.size(), IndexMap::kRemoved);
  std::vector<int> staying;
  std::vector<std::vector<int>> leaving(blocks.all.size());
  for (std::size_t i = 0; i < state->model.size(); ++i) {
    PointBinding& binding = state->model.bindings[i];
    const int point = static_cast<int>(i);
    const Blocks::Place place =
        binding.bound() ? places[static_cast<std::size_t>(binding.stencil)] : Blocks::Place();
    if (place.block >= 0) {
      binding.stencil = place.stencil;
      leaving[static_cast<std::size_t>(place.block)].push_back(point);
      continue;
    }
    if (binding.bound()) binding.stencil = numbers[static_cast<std::size_t>(binding.stencil)];
    map.new_of_old[i] = map.new_count++;
    staying.push_back(point);
  }
  parallelRanges(static_cast<int>(leaving.size()), 1, [&](int begin, int end) {
    for (std::size_t b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end); ++b)
      blocks.all[b].points = pointsOf(leaving[b], state->model);
  });
  state->model = pointsOf(staying, state->model);
  state->inactive.insert(state->inactive.end(), std::make_move_iterator(blocks.all.begin()),
                         std::make_move_iterator(blocks.all.end()));
  connectInactive(state);
  return map;
}

void activateAll(ModelState* state) {
  append(std::exchange(state->inactive, {}), state);
  connectInactive(state);
}

std::size_t countInactive(const ModelState& state) {
  std::size_t count = 0;
  for (const InactivePoints& block : state.inactive) count += block.points.size();
  return count;
}

}  // namespace softscope
