#include "deform/graph/graph_builder.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "deform/graph/carrier_finder.h"
#include "deform/graph/graph_edges.h"
#include "deform/graph/node_reach.h"
#include "deform/graph/shape_memory.h"
#include "deform/graph/surface_cells.h"

namespace softscope {
namespace {

using Positions = std::vector<Eigen::Vector3f>;
using Bindings = std::vector<PointBinding>;
using PointInCell = std::pair<int, int>;

constexpr double kReachesOfChange = 2;  // nothing changes farther from unbound points

/// The node closest to a position, of the first `count`; `count` without any.
std::size_t nearestNode(const WarpGraph& graph, std::size_t count,
                        const Eigen::Vector3d& position_mm) {
  std::size_t nearest = count;
  double nearest_mm2 = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < count; ++j) {
    const double away_mm2 = (graph.positions_mm[j] - position_mm).squaredNorm();
    if (!(away_mm2 < nearest_mm2)) continue;
    nearest_mm2 = away_mm2;
    nearest = j;
  }
  return nearest;
}

/// Numbers every set of nodes; drops unused numbers.
class StencilBook {
 public:
  explicit StencilBook(std::vector<NodeStencil>* stencils) : stencils_(stencils) {
    makeTable(4 * stencils->size());
  }

  std::int32_t numberOf(const NodeStencil& stencil) {
    std::int32_t& held = slotOf(stencil);
    if (held >= 0) return held;
    const std::int32_t number = held = static_cast<std::int32_t>(stencils_->size());
    stencils_->push_back(stencil);
    if (2 * stencils_->size() > slots_.size()) makeTable(2 * slots_.size());
    return number;
  }

  void dropUnused(Bindings* bindings) {
    std::vector<std::int32_t> renumbered = uses(*bindings);
    std::int32_t next = 0;
    for (std::size_t s = 0; s < stencils_->size(); ++s) {
      if (renumbered[s] < 0) continue;
      (*stencils_)[next] = (*stencils_)[s];
      renumbered[s] = next++;
    }
    if (next == static_cast<std::int32_t>(renumbered.size())) return;
    stencils_->resize(static_cast<std::size_t>(next));
    parallelRanges(static_cast<int>(bindings->size()), kPointsPerTask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        PointBinding& binding = (*bindings)[i];
        if (binding.bound()) binding.stencil = renumbered[binding.stencil];
      }
    });
  }

 private:
  /// Per stencil, 0 if a point is bound to it, else -1.
  std::vector<std::int32_t> uses(const Bindings& bindings) const {
    std::vector<std::atomic<bool>> is_used(stencils_->size());
    parallelRanges(static_cast<int>(bindings.size()), kPointsPerTask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        if (!bindings[i].bound()) continue;
        std::atomic<bool>& used = is_used[bindings[i].stencil];
        if (!used.load(std::memory_order_relaxed)) used.store(true, std::memory_order_relaxed);
      }
    });
    std::vector<std::int32_t> found(is_used.size());
    for (std::size_t s = 0; s < found.size(); ++s) found[s] = is_used[s] ? 0 : -1;
    return found;
  }
  void makeTable(std::size_t room) {
    std::size_t size = 64;
    while (size < room) size *= 2;
    slots_.assign(size, -1);
    for (std::size_t s = 0; s < stencils_->size(); ++s) {
      std::int32_t& held = slotOf((*stencils_)[s]);
      if (held < 0) held = static_cast<std::int32_t>(s);  // of equal ones the first
    }
  }
  /// Number of the stencil, or -1 at its slot.
  std::int32_t& slotOf(const NodeStencil& stencil) {
    std::uint64_t hash = 0;
    for (const std::int32_t node : stencil)
      hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15ULL;
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash >> 32) & mask;
    while (slots_[slot] >= 0 && (*stencils_)[slots_[slot]] != stencil) slot = (slot + 1) & mask;
    return slots_[slot];
  }

  std::vector<NodeStencil>* stencils_;
  std::vector<std::int32_t> slots_;  // open addressing; number of a stencil, or -1
};

/// Growth of the graph over the region around unbound points.
class Growth {
 public:
  Growth(const GraphOptions& options, const Positions& positions_mm,
         const std::vector<int>& unbound, Bindings* bindings, WarpGraph* graph)
      : options_(options),
        positions_mm_(positions_mm),
        bindings_(*bindings),
        graph_(*graph),
        region_(positions_mm, unbound, kReachesOfChange * NodeReach::reachMm(options),
                options.cell_mm),
        cells_(positions_mm, options.cell_mm, region_),
        reach_(cells_, options),
        near_new_node_(static_cast<std::size_t>(cells_.size()), 0) {
    for (std::size_t j = 0; j < graph_.size(); ++j) {
      const Eigen::Vector3f position_mm = graph_.positions_mm[j].cast<float>();
      if (region_.contains(position_mm)) waiting_.push_back({static_cast<int>(j), position_mm});
    }
    for (const int point : unbound)
      if (const int cell = cells_.cellAt(positions_mm[point]); cell >= 0)
        unbound_.emplace_back(point, cell);
  }

  GraphGrowth run() {
    const std::vector<NodeStencil> stencils_before = graph_.stencils;
    const std::vector<int> unbound = cellsOfUnbound();
    reach_.list(unbound);
    Positions centres_mm;
    for (const int cell : unbound) centres_mm.push_back(cells_.centre(cell));
    spreadNodesWithin(1, centres_mm);
    addNodes();
    bindPoints();
    result_.structure_changed =
        result_.nodes_added > 0 || graph_.stencils != stencils_before || graph_.edges.empty();
    if (result_.structure_changed) {
      const std::vector<GraphEdge> before =
          std::exchange(graph_.edges, makeEdges(graph_, options_));
      graph_.edge_shapes = edgeShapesOf(graph_.edges, before, graph_.edge_shapes);
    }
    return result_;
  }

 private:
  std::vector<int> cellsOfUnbound() const {
    std::vector<char> is_found(static_cast<std::size_t>(cells_.size()), 0);
    std::vector<int> found;
    for (const auto& [point, cell] : unbound_)
      if (!std::exchange(is_found[cell], 1)) found.push_back(cell);
    return found;
  }

  /// Walks are most of the work: only nodes that can reach one of the places walk.
  void spreadNodesWithin(double reaches, const Positions& places_mm) {
    const double distance_mm = reaches * NodeReach::surelyBeyondMm(options_);
    const auto limit_mm2 = static_cast<float>(distance_mm * distance_mm);
    const auto stays = [&](const NodeReach::Start& node) {
      return std::none_of(places_mm.begin(), places_mm.end(), [&](const Eigen::Vector3f& place_mm) {
        return (place_mm - node.position_mm).squaredNorm() <= limit_mm2;
      });
    };
    const auto first = std::partition(waiting_.begin(), waiting_.end(), stays);
    if (first == waiting_.end()) return;
    reach_.spreadAll({first, waiting_.end()});
    waiting_.erase(first, waiting_.end());
  }

  /// New tissue moved like the nearest known tissue: neither was visible before.
  NodeTransform motionNear(const Eigen::Vector3d& position_mm) const {
    const std::size_t nearest = nearestNode(graph_, graph_.size(), position_mm);
    if (nearest == graph_.size()) return {};
    NodeTransform motion = graph_.since_reference[nearest];
    motion.translation_mm =
        position_mm - beforeMotion(motion, graph_.positions_mm[nearest], position_mm);
    return motion;
  }

  /// In the order of the points: row by row of the image.
  void addNodes() {
    graph_.since_reference.resize(graph_.size());
    for (const auto& [point, cell] : unbound_) {
      if (reach_.covered(cell)) continue;
      const int node = static_cast<int>(graph_.size());
      const Eigen::Vector3f position_mm = positions_mm_[cells_.representative(cell)];
      // The cells that the new node reaches need all of their nodes.
      spreadNodesWithin(2, {position_mm});
      graph_.since_reference.push_back(motionNear(position_mm.cast<double>()));
      graph_.positions_mm.push_back(position_mm.cast<double>());
      graph_.transforms.emplace_back();
      for (const int reached : reach_.spread(node, position_mm)) near_new_node_[reached] = 1;
      ++result_.nodes_added;
    }
  }

  /// Those without a binding and those near a new node, ascending, with their cells.
  std::vector<PointInCell> pointsToBind() const {
    std::vector<PointInCell> to_bind = unbound_;
    for (int cell = 0; cell < cells_.size(); ++cell)
      if (near_new_node_[cell])
        cells_.visitPoints(cell, [&](int point) {
          if (bindings_[point].bound()) to_bind.emplace_back(point, cell);
        });
    std::sort(to_bind.begin(), to_bind.end());
    return to_bind;
  }

  void bindPoints() {
    const std::vector<PointInCell> to_bind = pointsToBind();
    std::vector<Carriers> carriers(to_bind.size());
    parallelRanges(static_cast<int>(to_bind.size()), kPointsPerTask / 8, [&](int begin, int end) {
      CarrierFinder finder(reach_, graph_, options_.node_spacing_mm);
      for (int k = begin; k < end; ++k)
        carriers[k] = finder.find(to_bind[k].second, positions_mm_[to_bind[k].first]);
    });
    StencilBook book(&graph_.stencils);
    for (std::size_t k = 0; k < to_bind.size(); ++k) {
      PointBinding& binding = bindings_[to_bind[k].first];
      ++(binding.bound() ? result_.points_rebound : result_.points_bound);
      binding.stencil = book.numberOf(carriers[k].stencil);
      binding.weights = carriers[k].weights;
    }
    book.dropUnused(&bindings_);
  }

  GraphOptions options_;
  const Positions& positions_mm_;
  Bindings& bindings_;
  WarpGraph& graph_;
  SurfaceRegion region_;
  SurfaceCells cells_;
  std::vector<PointInCell> unbound_;  // that are in one
  NodeReach reach_;
  std::vector<NodeReach::Start> waiting_;  // known nodes of the region that did not walk yet
  std::vector<char> near_new_node_;
  GraphGrowth result_;
};

}  // namespace

std::vector<int> unboundPoints(const Bindings& bindings) {
  return parallelFind(static_cast<int>(bindings.size()), kPointsPerTask,
                      [&](int begin, int end, std::vector<int>* found) {
                        for (int i = begin; i < end; ++i)
                          if (!bindings[i].bound()) found->push_back(i);
                      });
}

GraphGrowth growGraph(const GraphOptions& options, const std::vector<Eigen::Vector3f>& positions_mm,
                      std::vector<PointBinding>* bindings, WarpGraph* graph) {
  options.validate();
  const std::vector<int> unbound = unboundPoints(*bindings);
  if (unbound.empty()) return GraphGrowth();
  return Growth(options, positions_mm, unbound, bindings, graph).run();
}

GraphGrowth growGraph(const GraphOptions& options, PointModel* model, WarpGraph* graph) {
  return growGraph(options, model->positions_mm, &model->bindings, graph);
}

void followNeighbours(std::vector<NodeTransform> transforms, WarpGraph* graph) {
  const std::size_t known = transforms.size();
  for (std::size_t j = known; j < graph->size(); ++j) {
    const Eigen::Vector3d& position_mm = graph->positions_mm[j];
    const std::size_t nearest = nearestNode(*graph, known, position_mm);
    NodeTransform motion;
    if (nearest < known) {
      motion = transforms[nearest];
      motion.translation_mm =
          warpByNode(motion, graph->positions_mm[nearest], position_mm) - position_mm;
    }
    transforms.push_back(motion);
  }
  graph->transforms = std::move(transforms);
}

}  // namespace softscope
