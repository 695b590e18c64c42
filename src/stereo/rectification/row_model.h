// src/stereo/rectification/row_model.h: smooth model of the vertical disparity from single matches.
#pragma once

#include <vector>

#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// Where a pixel of the left image was found in the right one.
struct RowMatch {
  double u_right_px, v_right_px, difference_px;  // v_right - v_left
};

/// Least squares with Tukey's weights about the median, then about the model. Where there are no
/// matches the model is drawn to no difference, rather than follow its curvature. Too few matches
/// leave `alignment` as it is.
RowAlignment fitRowModel(const std::vector<RowMatch>& matches, RowAlignment alignment);

}  // namespace softscope
