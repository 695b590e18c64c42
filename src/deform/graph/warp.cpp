#include "deform/graph/warp.h"

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "deform/graph/shape_memory.h"
#include "deform/kernels/node_terms.h"

namespace softscope {
namespace {

/// The rotation nearest to the product, without the rounding of many products.
Eigen::Matrix3d turnedBy(const Eigen::Matrix3d& turn, const Eigen::Matrix3d& before) {
  return Eigen::Quaterniond(turn * before).normalized().toRotationMatrix();
}

}  // namespace

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "the kernels expect xyz triples");
static_assert(sizeof(NodeStencil) == 4 * sizeof(std::int32_t), "the kernels expect four ids");
static_assert(sizeof(PointBinding) == sizeof(std::int32_t) + 4 * sizeof(float),
              "the kernels expect a stencil and four weights");

std::vector<PackedNode> packNodes(const WarpGraph& graph) {
  std::vector<PackedNode> packed(graph.size());
  for (std::size_t j = 0; j < graph.size(); ++j)
    packed[j] = packNode(graph.positions_mm[j], graph.transforms[j]);
  return packed;
}

void warpRange(const std::vector<PackedNode>& nodes, const std::vector<NodeStencil>& stencils,
               const PointBinding* bindings, const Eigen::Vector3f* positions_mm,
               const Eigen::Vector3f* normals, int count, Eigen::Vector3f* warped_mm,
               Eigen::Vector3f* warped_normals) {
  if (count == 0) return;
  const std::int32_t* ids = stencils.empty() ? nullptr : stencils.front().data();
  deformKernels().warpPoints(nodes.data(), ids, bindings, sizeof(PointBinding),
                             positions_mm->data(), normals->data(), count, warped_mm->data(),
                             warped_normals->data());
}

void warpModel(const WarpGraph& graph, const std::vector<Eigen::Vector3f>& from_mm,
               const std::vector<Eigen::Vector3f>& from_normals, PointModel* model) {
  const std::vector<PackedNode> nodes = packNodes(graph);
  model->positions_mm.resize(from_mm.size());
  model->normals.resize(from_normals.size());
  parallelRanges(static_cast<int>(from_mm.size()), kPointsPerTask, [&](int begin, int end) {
    warpRange(nodes, graph.stencils, model->bindings.data() + begin, from_mm.data() + begin,
              from_normals.data() + begin, end - begin, model->positions_mm.data() + begin,
              model->normals.data() + begin);
  });
}

void warpModel(const WarpGraph& graph, PointModel* model) {
  warpModel(graph, model->positions_mm, model->normals, model);
}

Eigen::Vector3d warpPoint(const WarpGraph& graph, const PointBinding& binding,
                          const Eigen::Vector3d& point_mm) {
  if (!binding.bound()) return point_mm;
  Eigen::Vector3d warped = Eigen::Vector3d::Zero();
  double total = 0;
  const NodeStencil& stencil = graph.stencils[binding.stencil];
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const int node = stencil[k];
    warped += static_cast<double>(binding.weights[k]) *
              warpByNode(graph.transforms[node], graph.positions_mm[node], point_mm);
    total += binding.weights[k];
  }
  return warped / total;
}

void rebase(WarpGraph* graph) {
  graph->since_reference.resize(graph->size());
  graph->turned.resize(graph->size(), Eigen::Matrix3d::Identity());
  constexpr int kNodesPerTask = 512;
  parallelRanges(static_cast<int>(graph->size()), kNodesPerTask, [&](int begin, int end) {
    for (std::size_t j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end); ++j) {
      const NodeTransform& warp = graph->transforms[j];
      NodeTransform& motion = graph->since_reference[j];
      graph->positions_mm[j] += warp.translation_mm;
      motion.translation_mm += warp.translation_mm;
      motion.linear = turnedBy(warp.linear, motion.linear);
      graph->turned[j] = turnedBy(warp.linear, graph->turned[j]);
      graph->transforms[j] = NodeTransform();
    }
  });
  updateShapeMemory(graph);
}

}  // namespace softscope
