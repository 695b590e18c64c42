// eval/statistics/error_series.cpp: slopes of pairs, differences of neighbours.
#include "eval/statistics/error_series.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "eval/statistics/statistics.h"

namespace softscope {
namespace {

constexpr std::size_t kMostSamples = 2000;  // two million slopes

void requireSameLength(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size())
    throw InputError("a series of " + std::to_string(y.size()) + " errors has " +
                     std::to_string(x.size()) + " times; give one per sample");
}

std::vector<std::pair<double, double>> finiteSamples(const std::vector<double>& x,
                                                     const std::vector<double>& y) {
  std::vector<std::pair<double, double>> samples;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) samples.emplace_back(x[i], y[i]);
  const std::size_t step = (samples.size() + kMostSamples - 1) / kMostSamples;
  if (step <= 1) return samples;
  std::vector<std::pair<double, double>> fewer;
  for (std::size_t i = 0; i < samples.size(); i += step) fewer.push_back(samples[i]);
  return fewer;
}

}  // namespace

double theilSenSlope(const std::vector<double>& x, const std::vector<double>& y) {
  requireSameLength(x, y);
  const auto samples = finiteSamples(x, y);
  std::vector<double> slopes;
  slopes.reserve(samples.size() * samples.size() / 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = i + 1; j < samples.size(); ++j)
      if (samples[i].first != samples[j].first)
        slopes.push_back((samples[j].second - samples[i].second) /
                         (samples[j].first - samples[i].first));
  return percentiles(slopes, {50})[0];
}

std::vector<double> secondDifferences(const std::vector<double>& x, const std::vector<double>& y) {
  requireSameLength(x, y);
  std::vector<double> differences(y.size(), Statistics::kNone);
  for (std::size_t i = 1; i + 1 < y.size(); ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    if (std::abs(after - before) <= 0.01 * std::abs(before))
      differences[i] = y[i - 1] - 2 * y[i] + y[i + 1];
    if (!std::isfinite(differences[i])) differences[i] = Statistics::kNone;
  }
  return differences;
}

}  // namespace softscope
