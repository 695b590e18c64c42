// src/features/instrument_detector.h: instrument mask by colour, for sequences without mask files.
#pragma once

#include "core/image.h"

namespace softscope {

/// Tissue has red colours; instruments are grey, blue or dark, smooth, and enter from
/// the border. 1 on instruments by their colour, else 0. Same size. A heuristic, not
/// a learned detector: grey-blue tissue at the border is a false positive, and a jaw
/// that reflects tissue is missed. Recall and precision: docs/matching.md.
Mask detectInstruments(const ColourImage& image);

}  // namespace softscope
