// eval/surfaces/surface_comparison.cpp: search in both directions, shares and areas.
#include "eval/surfaces/surface_comparison.h"

#include <cmath>

#include "core/error.h"
#include "eval/distance/point_tree.h"
#include "eval/statistics/weighted_statistics.h"

namespace softscope {
namespace {

DirectedErrors directed(std::vector<double> each_mm, const std::vector<double>& areas_mm2) {
  DirectedErrors errors;
  errors.vertices_mm = statistics(each_mm);
  if (!areas_mm2.empty()) errors.area_mm = weightedStatistics(each_mm, areas_mm2);
  errors.each_mm = std::move(each_mm);
  return errors;
}

std::vector<double> distancesFrom(const TriangleMesh& test,
                                  const std::vector<Eigen::Vector3f>& points_mm) {
  if (test.empty()) return PointTree(test.vertices_mm).distances_mm(points_mm);
  std::vector<double> distances_mm;
  for (const ClosestPoint& closest : TriangleTree(test).closestPoints(points_mm))
    distances_mm.push_back(closest.distance_mm);
  return distances_mm;
}

double shareWithin(const std::vector<double>& distances_mm, double tau_mm) {
  double within = 0;
  for (const double distance_mm : distances_mm) within += distance_mm < tau_mm;
  return within / static_cast<double>(distances_mm.size());
}

double areaWithin(const std::vector<double>& distances_mm, const std::vector<double>& areas_mm2,
                  double tau_mm) {
  double area_mm2 = 0;
  for (std::size_t i = 0; i < areas_mm2.size(); ++i)
    if (distances_mm[i] < tau_mm) area_mm2 += areas_mm2[i];
  return area_mm2;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

ThresholdScores scoresAt(double tau_mm, const SurfaceComparison& comparison,
                         const std::vector<double>& test_areas_mm2,
                         const std::vector<double>& reference_areas_mm2) {
  const auto& forth_mm = comparison.accuracy.each_mm;
  const auto& back_mm = comparison.completeness.each_mm;
  ThresholdScores scores;
  scores.tau_mm = tau_mm;
  scores.precision = shareWithin(forth_mm, tau_mm);
  scores.recall = shareWithin(back_mm, tau_mm);
  const double sum = scores.precision + scores.recall;
  scores.f_score = sum == 0 ? 0 : 2 * scores.precision * scores.recall / sum;
  const double total_mm2 = sumOf(test_areas_mm2) + sumOf(reference_areas_mm2);
  if (!test_areas_mm2.empty() && total_mm2 > 0)
    scores.surface_dice = (areaWithin(forth_mm, test_areas_mm2, tau_mm) +
                           areaWithin(back_mm, reference_areas_mm2, tau_mm)) /
                          total_mm2;
  return scores;
}

}  // namespace

SurfaceComparison compareSurfaces(const TriangleMesh& reference, const TriangleMesh& test,
                                  const std::vector<double>& taus_mm) {
  for (const double tau_mm : taus_mm)
    require(tau_mm > 0 && std::isfinite(tau_mm), "tau", tau_mm, "must be above 0");
  if (test.vertices_mm.empty()) throw InputError("the test has no points; give a model that has");
  SurfaceComparison comparison;
  comparison.closest = TriangleTree(reference).closestPoints(test.vertices_mm);
  std::vector<double> forth_mm, signed_mm;
  for (const ClosestPoint& closest : comparison.closest) {
    forth_mm.push_back(closest.distance_mm);
    signed_mm.push_back(closest.signed_distance_mm);
  }
  const std::vector<double> reference_areas_mm2 = vertexAreas_mm2(reference);
  const std::vector<double> test_areas_mm2 =
      test.empty() ? std::vector<double>() : vertexAreas_mm2(test);
  comparison.signed_mm = statistics(signed_mm);
  comparison.accuracy = directed(std::move(forth_mm), test_areas_mm2);
  comparison.completeness =
      directed(distancesFrom(test, reference.vertices_mm), reference_areas_mm2);
  comparison.hausdorff =
      hausdorffDistances(comparison.accuracy.each_mm, comparison.completeness.each_mm);
  for (const double tau_mm : taus_mm)
    comparison.scores.push_back(scoresAt(tau_mm, comparison, test_areas_mm2, reference_areas_mm2));
  return comparison;
}

}  // namespace softscope
