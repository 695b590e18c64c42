// src/core/not_measured.h: value of a quantity without a measurement.
#pragma once

#include <limits>

namespace softscope {

/// NaN: std::isnan() and std::isfinite() detect it, comparisons with it are false.
template <class Real>
inline constexpr Real kNotMeasured = std::numeric_limits<Real>::quiet_NaN();

}  // namespace softscope
