// eval/distance/triangle_tree.cpp: checks, order of the queries, and the side of each answer.
#include "eval/distance/triangle_tree.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/farthest.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "eval/distance/morton_order.h"

namespace softscope {
namespace {

const TriangleMesh& checked(const TriangleMesh& mesh) {
  if (mesh.empty())
    throw InputError("the surface has no triangles, so no distance to it exists; give a mesh");
  const std::int32_t count = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::int32_t vertex : mesh.triangles[i])
      if (vertex < 0 || vertex >= count)
        throw InputError("triangle " + std::to_string(i) + " of the surface names vertex " +
                         std::to_string(vertex) + ", but there are " + std::to_string(count) +
                         " vertices, counted from 0; mend the mesh");
  for (std::int32_t i = 0; i < count; ++i)
    if (!(mesh.vertices_mm[i].cwiseAbs().maxCoeff() <= kFarthestMm) ||
        !mesh.vertices_mm[i].allFinite())
      throw InputError("vertex " + std::to_string(i) +
                       " of the surface is not finite or lies beyond 1 km; mend the mesh or its "
                       "unit (mm)");
  return mesh;
}

ClosestPoint noAnswer() {
  return {Eigen::Vector3d::Constant(kNotMeasured<double>),
          kNotMeasured<double>,
          kNotMeasured<double>,
          -1,
          SurfaceFeature::kNone,
          false,
          0};
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh)
    : vertices_mm_(checked(mesh).vertices_mm),
      triangles_(mesh.triangles),
      low_mm_(vertices_mm_[0]),
      high_mm_(vertices_mm_[0]),
      sides_(mesh),
      memory_(buildTree(mesh)) {
  for (const Eigen::Vector3f& v : vertices_mm_) {
    low_mm_ = low_mm_.cwiseMin(v);
    high_mm_ = high_mm_.cwiseMax(v);
  }
}

TreeView TriangleTree::view() const {
  TreeView view;
  view.nodes = memory_.nodes.data();
  view.leaves = memory_.leaves.data();
  view.node_count = static_cast<std::int32_t>(memory_.nodes.size());
  view.leaf_count = static_cast<std::int32_t>(memory_.leaves.size());
  view.vertices_mm = vertices_mm_[0].data();
  view.triangles = triangles_[0].data();
  view.slack_mm = memory_.slack_mm;
  return view;
}

ClosestPoint TriangleTree::describe(const TreeHit& hit, const Eigen::Vector3f& point_mm) const {
  if (hit.triangle < 0) return noAnswer();
  ClosestPoint answer;
  answer.point_mm = {hit.point_mm[0], hit.point_mm[1], hit.point_mm[2]};
  answer.distance_mm = std::sqrt(hit.distance2_mm2);
  answer.triangle = hit.triangle;
  if (hit.feature == kTreeFace) {
    answer.signed_distance_mm = hit.height_mm;
    answer.feature = SurfaceFeature::kFace;
    answer.on_border = false;
    answer.aside_mm = 0;
    return answer;
  }
  const Triangle& corners = triangles_[hit.triangle];
  const bool at_vertex = hit.feature >= kTreeVertex;
  const int i = hit.feature - (at_vertex ? kTreeVertex : kTreeEdge);
  const PseudoNormals::Side side =
      at_vertex ? sides_.ofVertex(corners[i]) : sides_.ofEdge(corners[i], corners[(i + 1) % 3]);
  const Eigen::Vector3d away_mm = point_mm.cast<double>() - answer.point_mm;
  const bool inside = away_mm.dot(side.normal) < 0;
  answer.signed_distance_mm = side.on_border ? kNotMeasured<double>
                              : inside       ? -answer.distance_mm
                                             : answer.distance_mm;
  answer.feature = at_vertex ? SurfaceFeature::kVertex : SurfaceFeature::kEdge;
  answer.on_border = side.on_border;
  answer.aside_mm = !side.on_border ? 0
                    : at_vertex     ? sides_.asideOfVertex(corners[i], away_mm)
                                    : sides_.asideOfEdge(corners[i], corners[(i + 1) % 3], away_mm);
  return answer;
}

std::vector<ClosestPoint> TriangleTree::closestPoints(
    const std::vector<Eigen::Vector3f>& points_mm) const {
  return closestPoints(points_mm, treeKernels());
}

std::vector<ClosestPoint> TriangleTree::closestPoints(const std::vector<Eigen::Vector3f>& points_mm,
                                                      const TreeKernels& kernels) const {
  std::vector<ClosestPoint> answers(points_mm.size(), noAnswer());
  const std::vector<std::uint32_t> order = mortonOrder(points_mm, low_mm_, high_mm_);
  std::vector<TreeHit> hits(points_mm.size());
  const TreeView tree = view();
  parallelRanges(static_cast<int>(order.size()), 512, [&](int begin, int end) {
    kernels.search(tree, points_mm[0].data(), order.data(), begin, end, hits.data());
    for (int i = begin; i < end; ++i)
      answers[order[i]] = describe(hits[order[i]], points_mm[order[i]]);
  });
  return answers;
}

}  // namespace softscope
