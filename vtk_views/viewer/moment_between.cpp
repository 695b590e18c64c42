// vtk_views/viewer/moment_between.cpp: node motion interpolated to the points.
#include "vtk_views/viewer/moment_between.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr std::size_t kNodes = 4;  // nodes per point

/// Over nodes present in both models, weighted by the inverse square of the distance.
Eigen::Vector3f motionAt(const Eigen::Vector3f& place, const std::vector<Eigen::Vector3f>& nodes_mm,
                         const std::vector<Eigen::Vector3f>& motion_mm) {
  std::array<float, kNodes> away{};
  std::array<std::size_t, kNodes> nearest{};
  away.fill(std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < motion_mm.size(); ++i) {
    float d = (nodes_mm[i] - place).squaredNorm();
    std::size_t node = i;
    for (std::size_t k = 0; k < kNodes; ++k)
      if (d < away[k]) {
        std::swap(d, away[k]);
        std::swap(node, nearest[k]);
      }
  }
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0;
  for (std::size_t k = 0; k < std::min(kNodes, motion_mm.size()); ++k) {
    const float weight = 1 / (away[k] + 1e-3f);
    sum += weight * motion_mm[nearest[k]];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

ViewMoment momentBetween(const ViewMoment& from, const ViewMoment& to, double share) {
  ViewMoment moment = from;
  moment.time_s += share * (to.time_s - from.time_s);
  if (from.world_from_left && to.world_from_left) {
    const Eigen::Quaterniond begin(from.world_from_left->linear()),
        end(to.world_from_left->linear());
    moment.world_from_left->linear() = begin.slerp(share, end).toRotationMatrix();
    moment.world_from_left->translation() = (1 - share) * from.world_from_left->translation() +
                                            share * to.world_from_left->translation();
  }
  std::vector<Eigen::Vector3f> motion_mm;
  for (std::size_t i = 0; i < std::min(from.nodes_mm.size(), to.nodes_mm.size()); ++i)
    motion_mm.push_back(float(share) * (to.nodes_mm[i] - from.nodes_mm[i]));
  if (motion_mm.empty()) return moment;
  for (auto* points : {&moment.model.vertices_mm, &moment.judged.vertices_mm})
    parallelRanges(static_cast<int>(points->size()), kPointsPerTask, [&](int begin, int end) {
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        (*points)[i] += motionAt((*points)[i], from.nodes_mm, motion_mm);
    });
  for (std::size_t i = 0; i < motion_mm.size(); ++i) moment.nodes_mm[i] += motion_mm[i];
  return moment;
}

std::shared_ptr<const ViewMoment> shownMoment(ViewSource& source, const Playback& playback,
                                              bool with_errors) {
  auto moment = source.moment(playback.index(), with_errors);
  const double share = playback.share();
  if (share <= 0) return moment;
  return std::make_shared<const ViewMoment>(
      momentBetween(*moment, *source.moment(playback.index() + 1, false), share));
}

}  // namespace softscope
