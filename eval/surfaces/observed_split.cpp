// eval/surfaces/observed_split.cpp: split by the distance to the observed surface.
#include "eval/surfaces/observed_split.h"

#include <cmath>

#include "core/error.h"
#include "eval/distance/point_tree.h"

namespace softscope {
namespace {

using Marks = std::vector<std::uint8_t>;

Marks markObserved(const TriangleMesh& observed, const std::vector<Eigen::Vector3f>& points_mm,
                   double reach_mm) {
  Marks seen;
  if (observed.empty()) {
    for (const double distance_mm : PointTree(observed.vertices_mm).distances_mm(points_mm))
      seen.push_back(distance_mm <= reach_mm);
    return seen;
  }
  for (const ClosestPoint& closest : TriangleTree(observed).closestPoints(points_mm))
    seen.push_back(closest.distance_mm <= reach_mm && !isBeyondBorder(closest));
  return seen;
}

std::vector<double> chosen(const std::vector<double>& values, const Marks& in) {
  std::vector<double> some;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (in[i] != 0) some.push_back(values[i]);
  return some;
}

double shareOf(std::size_t part, std::size_t whole) {
  return whole == 0 ? Statistics::kNone : double(part) / double(whole);
}

}  // namespace

ObservedSplit splitByObserved(const TriangleMesh& reference, const TriangleMesh& observed,
                              const SurfaceComparison& comparison, double reach_mm) {
  require(reach_mm > 0 && std::isfinite(reach_mm), "observed reach", reach_mm, "must be above 0");
  if (observed.vertices_mm.empty())
    throw InputError("what was observed has no points; give the scan, or a part of the surface");
  std::vector<Eigen::Vector3f> closest_mm;
  for (const ClosestPoint& c : comparison.closest) closest_mm.push_back(c.point_mm.cast<float>());
  ObservedSplit split;
  split.reach_mm = reach_mm;
  split.each_observed = markObserved(observed, closest_mm, reach_mm);
  Marks predicted, beyond;
  for (std::size_t i = 0; i < comparison.closest.size(); ++i) {
    beyond.push_back(isBeyondBorder(comparison.closest[i]));
    predicted.push_back(split.each_observed[i] == 0 && beyond[i] == 0);
    if (beyond[i] != 0) split.each_observed[i] = 0;
  }
  const Marks reference_in = markObserved(observed, reference.vertices_mm, reach_mm);
  const auto& each_mm = comparison.accuracy.each_mm;
  const auto seen_mm = chosen(each_mm, split.each_observed);
  const auto back_mm = chosen(comparison.completeness.each_mm, reference_in);
  split.observed_mm = statistics(seen_mm);
  split.predicted_mm = statistics(chosen(each_mm, predicted));
  split.beyond_share = shareOf(chosen(each_mm, beyond).size(), each_mm.size());
  split.completeness_mm = statistics(back_mm);
  split.hausdorff = hausdorffDistances(seen_mm, back_mm);
  split.test_share = shareOf(seen_mm.size(), split.each_observed.size());
  split.reference_share = shareOf(back_mm.size(), reference_in.size());
  split.not_reconstructed_share = percentAbove(back_mm, reach_mm) / 100;
  return split;
}

}  // namespace softscope
