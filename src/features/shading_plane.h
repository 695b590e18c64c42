// src/features/shading_plane.h: brightness that varies linearly across a window.
#pragma once

#include "core/hd.h"

namespace softscope {

/// Weighted sums over the pixels of a window, x and y from its centre.
struct WindowMomentsXy {
  double count, x, y, xx, xy, yy;
};

/// Brightness `constant` + `across` x + `down` y.
struct ShadingPlane {
  double constant, across, down;
};

/// Least squares fit of a plane: the inverse of its normal matrix.
class ShadingFit {
 public:
  ShadingFit() = default;
  SOFTSCOPE_FORMULA explicit ShadingFit(const WindowMomentsXy& m) {
    const double c00 = m.xx * m.yy - m.xy * m.xy, c01 = m.xy * m.y - m.x * m.yy,
                 c02 = m.x * m.xy - m.xx * m.y;
    const double scale = 1 / (m.count * c00 + m.x * c01 + m.y * c02);
    inverse_[0] = scale * c00;
    inverse_[1] = scale * c01;
    inverse_[2] = scale * c02;
    inverse_[3] = scale * (m.count * m.yy - m.y * m.y);
    inverse_[4] = scale * (m.x * m.y - m.count * m.xy);
    inverse_[5] = scale * (m.count * m.xx - m.x * m.x);
  }
  /// From the weighted sums of the values, of x times the values, and of y times the values.
  SOFTSCOPE_FORMULA ShadingPlane plane(double values, double x_values, double y_values) const {
    return {inverse_[0] * values + inverse_[1] * x_values + inverse_[2] * y_values,
            inverse_[1] * values + inverse_[3] * x_values + inverse_[4] * y_values,
            inverse_[2] * values + inverse_[4] * x_values + inverse_[5] * y_values};
  }

 private:
  double inverse_[6];
};

}  // namespace softscope
