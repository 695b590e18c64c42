// eval/images/predicted_sigma.h: calibration of a predicted standard error against true errors.
#pragma once

#include <cstddef>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// Share of errors within the intervals that contain 50, 68 and 95 % for a normal
/// distribution with the predicted sigma. A smaller share means that sigma is too small.
struct IntervalCoverage {
  double within_50 = Statistics::kNone, within_68 = Statistics::kNone,
         within_95 = Statistics::kNone;
  std::size_t count = 0;  // values with a finite error and a positive sigma
};

/// Throws InputError for different counts. NaN = unknown: excluded.
IntervalCoverage intervalCoverage(const std::vector<double>& errors,
                                  const std::vector<double>& sigmas);

/// Mean absolute error after removal of the values with the largest sigma.
struct Sparsification {
  std::vector<double> removed_share;  // 0, 0.1 … 0.9
  std::vector<double> mean_left;      // sorted by predicted sigma, the largest removed first
  std::vector<double> best_left;      // sorted by the error itself: lower bound
  /// Area between the two curves divided by the mean of all (AUSE;
  /// Ilg et al., ECCV 2018). 0: sigma and error have the same order.
  double area = Statistics::kNone;

  /// Mean error without the half with the largest sigma.
  double halfLeft() const { return mean_left.empty() ? Statistics::kNone : mean_left[5]; }
};

/// Input as in intervalCoverage(). Equal sigmas are removed in the order of the values.
Sparsification sparsification(const std::vector<double>& errors, const std::vector<double>& sigmas);

}  // namespace softscope
