// eval/surfaces/model_errors.cpp: distances in both directions, split by visibility.
#include "eval/surfaces/model_errors.h"

#include "core/error.h"
#include "core/parallel.h"
#include "eval/distance/point_tree.h"
#include "eval/surfaces/surface_alignment.h"
#include "eval/surfaces/surface_errors.h"

namespace softscope {
namespace {

/// A point represents its closest tissue point: visibility is that of the
/// tissue, so an erroneous point behind the surface is not treated as occluded.
std::vector<std::uint8_t> findObserved(const std::vector<ClosestPoint>& closest,
                                       const TrueMoment& truth) {
  const Eigen::Isometry3d left_from_world = truth.world_from_left.inverse();
  std::vector<std::uint8_t> observed(closest.size());
  parallelRanges(static_cast<int>(closest.size()), 4096, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      observed[static_cast<std::size_t>(i)] =
          !isBeyondBorder(closest[static_cast<std::size_t>(i)]) &&
          isSurfacePointVisible(truth.depth_mm, truth.rig.left,
                                left_from_world * closest[static_cast<std::size_t>(i)].point_mm);
  });
  return observed;
}

std::vector<double> chosen(const std::vector<double>& values,
                           const std::vector<std::uint8_t>& marks, bool mark) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); ++i)
    if ((marks[i] != 0) == mark) result.push_back(values[i]);
  return result;
}

Completeness completenessOf(const std::vector<double>& distances_mm, double completeness_mm) {
  Completeness result;
  result.distance_mm = statistics(distances_mm);
  if (distances_mm.empty()) return result;
  std::size_t near = 0;
  for (const double distance_mm : distances_mm) near += distance_mm < completeness_mm;
  result.share = static_cast<double>(near) / static_cast<double>(distances_mm.size());
  return result;
}

void splitByView(const std::vector<Eigen::Vector3f>& points_mm, const TrueMoment& truth,
                 double completeness_mm, ModelErrors& errors) {
  const std::vector<double> observed_mm = chosen(errors.each_mm, errors.each_observed, true);
  errors.observed_mm = statistics(observed_mm);
  errors.observed_signed_mm = statistics(chosen(errors.each_signed_mm, errors.each_observed, true));
  std::vector<std::uint8_t> known = errors.each_beyond;
  for (std::size_t i = 0; i < known.size(); ++i) known[i] |= errors.each_observed[i];
  errors.predicted_mm = statistics(chosen(errors.each_mm, known, false));
  errors.observed_share =
      static_cast<double>(observed_mm.size()) / static_cast<double>(points_mm.size());

  const TissueSamples tissue = sampleVisibleTissue(truth.depth_mm, truth.rig);
  const std::vector<double> left_mm =
      PointTree(points_mm).distances_mm(movePoints(truth.world_from_left, tissue.points_left_mm));
  const std::vector<double> both_mm = chosen(left_mm, tissue.in_both, true);
  errors.left = completenessOf(left_mm, completeness_mm);
  errors.both = completenessOf(both_mm, completeness_mm);
  errors.hausdorff = hausdorffDistances(observed_mm, both_mm);
}

}  // namespace

ModelErrors modelErrors(const std::vector<Eigen::Vector3f>& points_mm, const TrueMoment& truth,
                        double completeness_mm) {
  if (points_mm.empty())
    throw InputError("the model has no points, so no errors; give a model that has some");
  const std::vector<ClosestPoint> closest = truth.surface.closestPoints(points_mm);
  ModelErrors errors;
  errors.each_mm.reserve(closest.size());
  errors.each_signed_mm.reserve(closest.size());
  for (const ClosestPoint& c : closest) {
    errors.each_mm.push_back(c.distance_mm);
    errors.each_signed_mm.push_back(c.signed_distance_mm);
    errors.border_count += c.on_border;
    errors.each_beyond.push_back(isBeyondBorder(c));
    errors.beyond_count += errors.each_beyond.back();
  }
  errors.distance_mm = statistics(errors.each_mm);
  errors.signed_mm = statistics(errors.each_signed_mm);
  if (truth.depth_mm.empty()) return errors;
  errors.each_observed = findObserved(closest, truth);
  splitByView(points_mm, truth, completeness_mm, errors);
  return errors;
}

}  // namespace softscope
