// eval/statistics/cohort.cpp: closed formulas, and one seeded bootstrap.
#include "eval/statistics/cohort.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/error.h"

namespace softscope {
namespace {

constexpr int kResamples = 2000;
constexpr double kNormal975 = 1.959963984540054;
constexpr std::size_t kMostExact = 25;

double sampleSd(const std::vector<double>& numbers, double mean) {
  if (numbers.size() < 2) return Statistics::kNone;
  double squares = 0;
  for (const double x : numbers) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(numbers.size() - 1));
}

double meanOf(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

/// The continued fraction of the incomplete beta function, by Lentz's method.
double betaFraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  const auto away = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / away(1 - (a + b) * x / (a + 1)), fraction = d;
  for (int m = 1; m <= 500; ++m) {
    for (const double term : {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                              -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))}) {
      d = 1 / away(1 + term * d);
      c = away(1 + term / c);
      fraction *= d * c;
    }
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return fraction;
}

/// The regularised incomplete beta function.
double incompleteBeta(double a, double b, double x) {
  if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
  const double factor = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                 a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? factor * betaFraction(a, b, x) / a
                                   : 1 - factor * betaFraction(b, a, 1 - x) / b;
}

/// Probability of Student's t above `t` >= 0.
double studentTail(double t, double degrees) {
  return 0.5 * incompleteBeta(degrees / 2, 0.5, degrees / (degrees + t * t));
}

/// Ranks (from 1) of the magnitudes, averaged for ties; `ties` receives the sum of m^3 - m.
std::vector<double> ranksOf(const std::vector<double>& differences, double& ties) {
  std::vector<std::size_t> order(differences.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto magnitude = [&](std::size_t i) { return std::abs(differences[i]); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return magnitude(a) < magnitude(b); });
  std::vector<double> ranks(differences.size());
  ties = 0;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && magnitude(order[end]) == magnitude(order[begin])) ++end;
    const auto together = static_cast<double>(end - begin);
    ties += together * (together * together - 1);
    for (std::size_t k = begin; k < end; ++k)
      ranks[order[k]] = (static_cast<double>(begin + end) + 1) / 2;
  }
  return ranks;
}

/// Share of all sign combinations whose sum of positive ranks has at least the distance of
/// `rank_sum` from the mean. Ranks are multiples of 1/2, so sums are counted in halves.
double exactSignedRank(const std::vector<double>& ranks, double rank_sum) {
  const double total = std::accumulate(ranks.begin(), ranks.end(), 0.0);
  std::vector<double> ways(static_cast<std::size_t>(std::lround(2 * total)) + 1, 0);
  ways[0] = 1;
  for (const double rank : ranks) {
    const auto step = static_cast<std::size_t>(std::lround(2 * rank));
    for (std::size_t s = ways.size(); s-- > step;) ways[s] += ways[s - step];
  }
  const double off = std::abs(rank_sum - total / 2) - 1e-9;
  double extreme = 0;
  for (std::size_t s = 0; s < ways.size(); ++s)
    if (std::abs(static_cast<double>(s) / 2 - total / 2) >= off) extreme += ways[s];
  return extreme / std::pow(2.0, static_cast<double>(ranks.size()));
}

double normalSignedRank(double count, double rank_sum, double ties) {
  const double variance = count * (count + 1) * (2 * count + 1) / 24 - ties / 48;
  const double off = std::max(std::abs(rank_sum - count * (count + 1) / 4) - 0.5, 0.0);
  return std::erfc(off / std::sqrt(2 * variance));
}

}  // namespace

double studentQuantile(double probability, double degrees) {
  require(probability > 0 && probability < 1, "probability", probability, "must be in (0, 1)");
  require(degrees > 0, "degrees", degrees, "must be above 0");
  const double tail = std::min(probability, 1 - probability);
  double low = 0, high = 1;
  while (studentTail(high, degrees) > tail && high < 1e12) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double middle = (low + high) / 2;
    (studentTail(middle, degrees) > tail ? low : high) = middle;
  }
  return probability < 0.5 ? -(low + high) / 2 : (low + high) / 2;
}

Interval meanInterval(const Statistics& values) {
  if (values.count < 2) return {};
  const double degrees = static_cast<double>(values.count) - 1;
  const double half = studentQuantile(0.975, degrees) * values.sd / std::sqrt(degrees);  // sd: n
  return {values.mean - half, values.mean + half};
}

Interval bootstrapMean(const std::vector<double>& values, std::uint64_t seed) {
  const std::vector<double> numbers = withoutNaN(values);
  if (numbers.size() < 3) return {};
  std::mt19937_64 random(seed);
  const auto drawn = [&] {  // the distributions of the standard library are not portable
    return static_cast<std::size_t>((random() >> 32) * numbers.size() >> 32);
  };
  std::vector<double> means;
  for (int i = 0; i < kResamples; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) sum += numbers[drawn()];
    means.push_back(sum / static_cast<double>(numbers.size()));
  }
  const std::vector<double> ends = percentiles(means, {2.5, 97.5});
  return {ends[0], ends[1]};
}

CohortSummary summariseCohort(const std::vector<double>& values, std::uint64_t seed) {
  const std::vector<double> numbers = withoutNaN(values);
  CohortSummary summary;
  summary.count = numbers.size();
  if (numbers.empty()) return summary;
  summary.mean = meanOf(numbers);
  summary.sd = sampleSd(numbers, summary.mean);
  const std::vector<double> quartiles = percentiles(numbers, {25, 50, 75});
  summary.quartile_1 = quartiles[0];
  summary.median = quartiles[1];
  summary.quartile_3 = quartiles[2];
  summary.mean_ci = bootstrapMean(numbers, seed);
  return summary;
}

BlandAltman blandAltman(const std::vector<double>& differences) {
  const std::vector<double> numbers = withoutNaN(differences);
  BlandAltman result;
  result.count = numbers.size();
  if (numbers.empty()) return result;
  result.bias = meanOf(numbers);
  result.sd = sampleSd(numbers, result.bias);
  if (numbers.size() < 2) return result;
  const auto n = static_cast<double>(numbers.size());
  const double t = studentQuantile(0.975, n - 1);
  const auto around = [](double middle, double half) {
    return Interval{middle - half, middle + half};
  };
  result.limits = around(result.bias, kNormal975 * result.sd);
  result.bias_ci = around(result.bias, t * result.sd / std::sqrt(n));
  const double limit_half =
      t * result.sd * std::sqrt(1 / n + kNormal975 * kNormal975 / (2 * (n - 1)));
  result.low_limit_ci = around(result.limits.low, limit_half);
  result.high_limit_ci = around(result.limits.high, limit_half);
  return result;
}

SignedRankTest signedRankTest(const std::vector<double>& differences) {
  std::vector<double> numbers;
  for (const double d : differences)
    if (!std::isnan(d) && d != 0) numbers.push_back(d);
  SignedRankTest test;
  test.count = numbers.size();
  if (numbers.empty()) return test;
  double ties = 0;
  const std::vector<double> ranks = ranksOf(numbers, ties);
  test.rank_sum = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] > 0) test.rank_sum += ranks[i];
  test.p_value = numbers.size() <= kMostExact
                     ? exactSignedRank(ranks, test.rank_sum)
                     : normalSignedRank(static_cast<double>(numbers.size()), test.rank_sum, ties);
  return test;
}

}  // namespace softscope
