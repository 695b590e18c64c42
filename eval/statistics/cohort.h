// eval/statistics/cohort.h: statistics over cases with confidence intervals. Definitions:
// docs/report.md.
#pragma once

#include <cstdint>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// NaN where it is not defined.
struct Interval {
  double low = Statistics::kNone, high = Statistics::kNone;
};

/// One value a case; NaNs left out.
struct CohortSummary {
  std::size_t count = 0;
  double mean = Statistics::kNone;
  double sd = Statistics::kNone;  // of the sample, over count - 1; NaN for one case
  double median = Statistics::kNone, quartile_1 = Statistics::kNone, quartile_3 = Statistics::kNone;
  Interval mean_ci;  // 95 %, percentile bootstrap; NaN for fewer than three cases
};
CohortSummary summariseCohort(const std::vector<double>& values, std::uint64_t seed);

/// 95 % percentile bootstrap interval of the mean: 2000 resamples, drawn by `seed` alone, so the
/// same everywhere. NaNs left out; NaN for fewer than three values.
Interval bootstrapMean(const std::vector<double>& values, std::uint64_t seed);

/// Bland and Altman (1986, 1999), of differences, one a case.
struct BlandAltman {
  std::size_t count = 0;
  double bias = Statistics::kNone;  // mean difference
  double sd = Statistics::kNone;    // of the differences, over count - 1
  Interval limits;                  // of agreement: bias -+ 1.96 sd
  // 95 % by Student's t: of the bias from sd / sqrt(n), of a limit from sd sqrt(1/n
  // + 1.96^2/2/(n-1))
  Interval bias_ci, low_limit_ci, high_limit_ci;
};
/// NaNs left out; all but the count and the bias are NaN for fewer than two.
BlandAltman blandAltman(const std::vector<double>& differences);

/// Wilcoxon's signed-rank test of paired differences, two-sided: zeros left out, tied ranks
/// averaged; exact for up to 25 differences, else by the normal approximation with the correction
/// for ties and continuity.
struct SignedRankTest {
  std::size_t count = 0;                // of differences other than 0
  double rank_sum = Statistics::kNone;  // of the positive ones
  double p_value = Statistics::kNone;
};
SignedRankTest signedRankTest(const std::vector<double>& differences);

/// The point below which Student's t with `degrees` of freedom (> 0) lies with `probability`, in
/// (0, 1). Throws OptionError.
double studentQuantile(double probability, double degrees);

}  // namespace softscope
