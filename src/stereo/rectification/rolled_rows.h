// src/stereo/rectification/rolled_rows.h: search for a rolled camera.
#pragma once

#include "core/image.h"
#include "core/row_plane.h"
#include "stereo/rectification/row_meter.h"

namespace softscope {

/// Rows of a right camera that is rolled so far that no common offset of rows matches, to 10°;
/// unknown (0) where matches without roll agree, or hardly more of them with one. `meter` is that
/// of the left image.
RowPlane findRolledRows(const RowMeter& meter, const GrayImage& right);

}  // namespace softscope
