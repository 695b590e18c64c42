// src/core/tolerance.h: the error that a result may have.
#pragma once

namespace softscope {

/// Larger errors make a frame wrong (docs/evaluation.md); depths that are predicted to have
/// larger ones give it no confidence (docs/fusion.md, F27).
constexpr double kTolerableErrorMm = 1;

}  // namespace softscope
