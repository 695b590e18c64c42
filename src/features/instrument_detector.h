// src/features/instrument_detector.h: finds metal and plastic by colour, where no mask file does.
#pragma once

#include "core/image.h"

namespace softscope {

/// Tissue is lit red; instruments are grey, blue or dark, smooth, and come in from the border.
/// 1 on instruments as far as colour tells them, else 0. Same shape. A rule of thumb, not a learned
/// detector: grey-blue tissue at the border is taken for an instrument, and a jaw that reflects
/// tissue is missed. docs/matching.md has its recall and precision.
Mask detectInstruments(const ColourImage& image);

}  // namespace softscope
