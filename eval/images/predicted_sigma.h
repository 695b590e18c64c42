// eval/images/predicted_sigma.h: calibration of a predicted standard error against true errors.
#pragma once

#include <cstddef>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// Of a normal distribution with the predicted sigma: the share of errors that lie within the
/// interval which would hold 50, 68 and 95 % of them. Lower than its name: sigma is too small.
struct IntervalCoverage {
  double within_50 = Statistics::kNone, within_68 = Statistics::kNone,
         within_95 = Statistics::kNone;
  std::size_t count = 0;  // values with a finite error and a sigma above 0
};

/// Throws InputError where the counts differ. NaN = not known: left out.
IntervalCoverage intervalCoverage(const std::vector<double>& errors,
                                  const std::vector<double>& sigmas);

/// Mean absolute error after removal of the values with the largest sigma.
struct Sparsification {
  std::vector<double> removed_share;  // 0, 0.1 … 0.9
  std::vector<double> mean_left;      // by predicted sigma, the largest removed first
  std::vector<double> best_left;      // by the error itself: no prediction can do better
  /// Area between the two curves over the mean of all (AUSE; Ilg et al., ECCV 2018). 0: sigma sorts
  /// as the error does.
  double area = Statistics::kNone;
};

/// As intervalCoverage(). Equal sigmas are removed in the order of the values.
Sparsification sparsification(const std::vector<double>& errors, const std::vector<double>& sigmas);

}  // namespace softscope
