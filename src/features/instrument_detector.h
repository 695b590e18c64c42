// src/features/instrument_detector.h: instrument mask by colour, for sequences without mask files.
#pragma once

#include "core/image.h"

namespace softscope {

/// Tissue is lit red; instruments are grey, blue or dark, smooth, and come in from the border.
/// 1 on instruments by their colour, else 0. Same shape. A rule of thumb, not a learned
/// detector: grey-blue tissue at the border is taken for an instrument, and a jaw that reflects
/// tissue is missed. docs/matching.md has its recall and precision.
Mask detectInstruments(const ColourImage& image);

}  // namespace softscope
