// src/stereo/row_alignment.h: do rows really correspond?
#pragma once

#include "core/image.h"

namespace softscope {

/// What matched corners say about the rows of a rectified pair. Row difference = v_right - v_left;
/// its model is shift + tilt (u - width / 2).
struct RowAlignment {
  int matches = 0;                    // corners that were matched; below kFewestMatches no model
  double mean_row_difference_px = 0;  // mean absolute difference
  double shift_px = 0;
  double tilt_px_per_px = 0;
  double residual_px = 0;  // mean absolute difference after the model is removed

  static constexpr int kFewestMatches = 20;
  static constexpr double kWarnAbovePx = 0.5;
  bool known() const { return matches >= kFewestMatches; }
};

/// Matches corners of the left picture in the right one over `disparity_max_px` columns and a few
/// rows, by normalised correlation, to a tenth of a pixel. Never fails: few matches mean !known().
RowAlignment measureRowAlignment(const GrayImage& left, const GrayImage& right,
                                 int disparity_max_px);

/// The right picture moved so that the model's row difference vanishes.
ColourImage removeRowError(const ColourImage& right, const RowAlignment& alignment);

}  // namespace softscope
