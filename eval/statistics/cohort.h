// eval/statistics/cohort.h: statistics over cases with confidence intervals. Definitions:
// docs/report.md.
#pragma once

#include <cstdint>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// NaN if undefined.
struct Interval {
  double low = Statistics::kNone, high = Statistics::kNone;
};

/// One value per case, without NaNs.
struct CohortSummary {
  std::size_t count = 0;
  double mean = Statistics::kNone;
  double sd = Statistics::kNone;  // sample standard deviation, divisor count - 1; NaN for one case
  double median = Statistics::kNone, quartile_1 = Statistics::kNone, quartile_3 = Statistics::kNone;
  Interval mean_ci;  // 95 %, percentile bootstrap; NaN for fewer than three cases
};
CohortSummary summariseCohort(const std::vector<double>& values, std::uint64_t seed);

/// 95 % percentile bootstrap interval of the mean: 2000 resamples,
/// determined by `seed`. Without NaNs; NaN for fewer than three values.
Interval bootstrapMean(const std::vector<double>& values, std::uint64_t seed);

/// Bland and Altman (1986, 1999), one difference per case.
struct BlandAltman {
  std::size_t count = 0;
  double bias = Statistics::kNone;  // mean difference
  double sd = Statistics::kNone;    // of the differences, divisor count - 1
  Interval limits;                  // of agreement: bias -+ 1.96 sd
  // 95 % by Student's t: of the bias from sd / sqrt(n), of a limit from sd sqrt(1/n
  // + 1.96^2/2/(n-1))
  Interval bias_ci, low_limit_ci, high_limit_ci;
};
/// Without NaNs; all but the count and the bias are NaN for fewer than two.
BlandAltman blandAltman(const std::vector<double>& differences);

/// Wilcoxon's signed-rank test of paired differences, two-sided:
/// without zeros, tied ranks averaged; exact for up to 25 differences,
/// else normal approximation with correction for ties and continuity.
struct SignedRankTest {
  std::size_t count = 0;                // of differences other than 0
  double rank_sum = Statistics::kNone;  // of the positive ones
  double p_value = Statistics::kNone;
};
SignedRankTest signedRankTest(const std::vector<double>& differences);

/// 95 % interval of the mean by Student's t; NaN for fewer than two values.
Interval meanInterval(const Statistics& values);

/// Quantile of Student's t with `degrees` of freedom (>
/// 0) at `probability` in (0, 1). Throws OptionError.
double studentQuantile(double probability, double degrees);

}  // namespace softscope
