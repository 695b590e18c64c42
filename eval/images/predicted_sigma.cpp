// eval/images/predicted_sigma.cpp: counts within
// intervals, and cumulative means of a sorted list.
#include "eval/images/predicted_sigma.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"

namespace softscope {
namespace {

// Half widths of the central intervals of a normal distribution, in standard deviations.
constexpr double kOf50 = 0.6744897502, kOf68 = 0.9944578832, kOf95 = 1.9599639845;
constexpr int kSteps = 10;

using Pairs = std::vector<std::pair<double, double>>;  // magnitude of the error, sigma

Pairs knownPairs(const std::vector<double>& errors, const std::vector<double>& sigmas) {
  if (errors.size() != sigmas.size())
    throw InputError("predicted sigma: one per error is needed, but there are " +
                     std::to_string(sigmas.size()) + " for " + std::to_string(errors.size()));
  Pairs pairs;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (std::isfinite(errors[i]) && std::isfinite(sigmas[i]) && sigmas[i] > 0)
      pairs.emplace_back(std::abs(errors[i]), sigmas[i]);
  return pairs;
}

/// Means of the first values, for decreasing numbers of values.
std::vector<double> meansLeft(const Pairs& sorted) {
  std::vector<double> sums{0};
  for (const auto& [error, sigma] : sorted) sums.push_back(sums.back() + error);
  std::vector<double> means;
  for (int step = 0; step < kSteps; ++step) {
    const std::size_t left = std::max<std::size_t>(
        1, sorted.size() - sorted.size() * static_cast<std::size_t>(step) / kSteps);
    means.push_back(sums[left] / static_cast<double>(left));
  }
  return means;
}

}  // namespace

IntervalCoverage intervalCoverage(const std::vector<double>& errors,
                                  const std::vector<double>& sigmas) {
  const Pairs pairs = knownPairs(errors, sigmas);
  IntervalCoverage coverage;
  coverage.count = pairs.size();
  if (pairs.empty()) return coverage;
  const auto within = [&](double widths) {
    const auto inside = std::count_if(pairs.begin(), pairs.end(), [&](const auto& pair) {
      return pair.first <= widths * pair.second;
    });
    return static_cast<double>(inside) / static_cast<double>(pairs.size());
  };
  coverage.within_50 = within(kOf50);
  coverage.within_68 = within(kOf68);
  coverage.within_95 = within(kOf95);
  return coverage;
}

Sparsification sparsification(const std::vector<double>& errors,
                              const std::vector<double>& sigmas) {
  Pairs pairs = knownPairs(errors, sigmas);
  Sparsification result;
  if (pairs.empty()) return result;
  for (int step = 0; step < kSteps; ++step) result.removed_share.push_back(step / double(kSteps));
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.second < b.second; });
  result.mean_left = meansLeft(pairs);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  result.best_left = meansLeft(pairs);
  double area = 0;
  for (std::size_t i = 0; i < result.mean_left.size(); ++i)
    area += (result.mean_left[i] - result.best_left[i]) / kSteps;
  if (result.mean_left[0] > 0) result.area = area / result.mean_left[0];
  return result;
}

}  // namespace softscope
