// src/stereo/rectification/row_model.h: smooth model of the vertical disparity from single matches.
#pragma once

#include <vector>

#include "core/row_plane.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// Match of a pixel of the left image in the right one. Searches in several rows find it
/// repeatedly.
struct RowMatch {
  double u_right_px, v_right_px, difference_px;  // v_right - v_left
  int u_left_px = 0, v_left_px = 0;
};

/// The plane as a model.
RowAlignment withModel(const RowPlane& plane, RowAlignment scale);

/// Least squares with Tukey's weights about the median, then about the
/// model. Without matches the model is drawn to the expected rows and to the difference from them
/// that the matches have in common, instead of an extrapolated slope or curvature. Too few matches
/// leave `alignment` unchanged.
RowAlignment fitRowModel(std::vector<RowMatch> matches, RowAlignment alignment,
                         const RowPlane& expected = {});

/// Plane of the matches of several frames, by the same weights; slopes are drawn to the expected
/// ones. Needs one match.
RowPlane fitRowPlane(std::vector<RowMatch> matches, RowAlignment scale,
                     const RowPlane& expected = {});

}  // namespace softscope
