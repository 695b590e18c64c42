// src/features/instrument_detector.h: finds metal and plastic by colour, where no mask file does.
#pragma once

#include "core/image.h"

namespace softscope {

/// Tissue is lit red; instruments are grey, blue or dark, smooth, and come in from the border.
struct InstrumentOptions {
  double max_redness = -0.02;    // (R - (G + B) / 2) / (R + G + B) of a candidate, at most
  int min_brightness = 25;       // mean of the channels; darker pixels have no colour …
  int open_px = 4;               // candidates narrower than twice this are dropped
  int close_px = 6;              // holes narrower than twice this (prints, highlights) are filled
  double min_area_share = 0.01;  // of the picture
  int max_border_gap_px = 8;     // an instrument begins this near to the border
  int grow_px = 10;              // its shadowed rim goes too

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// 1 on instruments as far as colour tells them, else 0. Same shape. A rule of thumb, not a learned
/// detector: grey-blue tissue at the border is taken for an instrument, and a jaw that reflects
/// tissue is missed. docs/matching.md has its recall and precision.
Mask detectInstruments(const ColourImage& image, const InstrumentOptions& options);

}  // namespace softscope
