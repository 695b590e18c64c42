// src/deform/energy/robust_loss.h: robust loss of a residual and its weight.
#pragma once

#include <cmath>

#include "core/hd.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Cost rho and weight rho' of a squared residual, docs/energy.md (13), (14). For small residuals
/// they equal the squared residual and 1.
struct RobustValue {
  double cost;
  double weight;
};

/// Square of the size of a match, of its three residuals: docs/energy.md (12).
SOFTSCOPE_HD inline double squaredMatch(const double* residuals) {
  return residuals[0] * residuals[0] + residuals[1] * residuals[1] + residuals[2] * residuals[2];
}

SOFTSCOPE_HD inline RobustValue robustValue(const RobustOptions& robust, double squared) {
  const double limit = robust.scale_mm * robust.scale_mm;
  if (robust.loss == RobustLoss::kHuber && squared > limit) {
    const double size = std::sqrt(squared);
    return {2 * robust.scale_mm * size - limit, robust.scale_mm / size};
  }
  return {squared, 1};
}

}  // namespace softscope
