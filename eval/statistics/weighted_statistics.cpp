// eval/statistics/weighted_statistics.cpp: statistics from values sorted once.
#include "eval/statistics/weighted_statistics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace softscope {
namespace {

using Samples = std::vector<std::pair<double, double>>;  // value, weight; sorted by value

Samples sortedSamples(const std::vector<double>& values, const std::vector<double>& weights,
                      Statistics& result) {
  if (values.size() != weights.size())
    throw InputError(std::to_string(values.size()) + " values have " +
                     std::to_string(weights.size()) + " weights; give one per value");
  Samples samples;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(weights[i] >= 0 && std::isfinite(weights[i])))
      throw InputError("weight " + std::to_string(i) + " is " + std::to_string(weights[i]) +
                       ", but must be 0 or more");
    result.nan_count += std::isnan(values[i]);
    if (!std::isnan(values[i]) && weights[i] > 0) samples.emplace_back(values[i], weights[i]);
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

double percentileOf(const Samples& samples, double total, double percent) {
  const double wanted = percent / 100 * total;
  double below = 0;  // sum of the weights before sample i
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double middle = below + samples[i].second / 2;
    if (wanted <= middle) {
      if (i == 0) return samples[0].first;
      const double last_middle = below - samples[i - 1].second / 2;
      const double part = (wanted - last_middle) / (middle - last_middle);
      return samples[i - 1].first + part * (samples[i].first - samples[i - 1].first);
    }
    below += samples[i].second;
  }
  return samples.back().first;
}

}  // namespace

Statistics weightedStatistics(const std::vector<double>& values,
                              const std::vector<double>& weights) {
  Statistics result;
  const Samples samples = sortedSamples(values, weights, result);
  result.count = samples.size();
  if (samples.empty()) return result;
  double total = 0, sum = 0, squares = 0, deviations = 0;
  for (const auto& [value, weight] : samples) {
    total += weight;
    sum += weight * value;
    squares += weight * value * value;
  }
  result.mean = sum / total;
  for (const auto& [value, weight] : samples)
    deviations += weight * (value - result.mean) * (value - result.mean);
  result.sd = std::sqrt(deviations / total);
  result.rmse = std::sqrt(squares / total);
  result.min = samples.front().first;
  result.max = samples.back().first;
  result.median = percentileOf(samples, total, 50);
  result.p95 = percentileOf(samples, total, 95);
  return result;
}

std::vector<double> vertexAreas_mm2(const TriangleMesh& mesh) {
  std::vector<double> areas_mm2(mesh.vertices_mm.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[static_cast<std::size_t>(t[0])].cast<double>();
    const Eigen::Vector3d b = mesh.vertices_mm[static_cast<std::size_t>(t[1])].cast<double>();
    const Eigen::Vector3d c = mesh.vertices_mm[static_cast<std::size_t>(t[2])].cast<double>();
    const double third_mm2 = (b - a).cross(c - a).norm() / 6;
    for (const std::int32_t vertex : t) areas_mm2[static_cast<std::size_t>(vertex)] += third_mm2;
  }
  return areas_mm2;
}

}  // namespace softscope
