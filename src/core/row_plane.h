// src/core/row_plane.h: vertical disparity that a calibration leaves in all frames.
#pragma once

namespace softscope {

/// Row difference v_right - v_left of rectified views, as a plane over the right image: small
/// errors of pitch and roll of a camera. 0: unknown.
struct RowPlane {
  double centre_px = 0;                // at the image's centre
  double per_column = 0, per_row = 0;  // px per px from it

  bool isKnown() const { return centre_px != 0 || per_column != 0 || per_row != 0; }
};

}  // namespace softscope
