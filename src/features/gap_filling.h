// src/features/gap_filling.h: filling of thin gaps of the model view.
#pragma once

#include "features/model_view.h"

namespace softscope {

/// Fills runs of up to `gap_px` pixels of a row, then of a column, that are empty or more than
/// `step_mm` behind the pixels on both ends, if these are within `step_mm` of each other:
/// inverse depth and colours are interpolated, the point index is that of the nearer end.
void fillGaps(int gap_px, float step_mm, ModelView* view);

}  // namespace softscope
