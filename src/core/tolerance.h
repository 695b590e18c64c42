// src/core/tolerance.h: the error that a result may have.
#pragma once

namespace softscope {

/// Larger errors make a frame wrong (docs/evaluation.md); depths and tracked points that are
/// predicted to have larger ones give it no confidence (docs/fusion.md, F27).
constexpr double kTolerableErrorMm = 1;

/// Largest predicted error that is tolerable with a probability of 95 %.
constexpr double kPreciseSigmaMm = kTolerableErrorMm / 1.96;

}  // namespace softscope
