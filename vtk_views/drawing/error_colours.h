// vtk_views/drawing/error_colours.h: errors as colours, and the bar that explains them.
#pragma once

#include <string>

#include "core/image.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// One range for everything that is to be compared by eye.
struct ErrorColours {
  bool with_sign = false;  // viridis from 0 to limit, or blue-white-red from -limit to limit
  double limit_mm = 1;     // above 0

  double low_mm() const { return with_sign ? -limit_mm : 0; }
  /// Beyond the range: its end's. NaN: kUnmeasuredGrey.
  Rgb8 colour(double error_mm) const;
};

/// Blue below 0, white at 0, red above; `position` from -1 to 1, clamped. Lightness falls evenly to
/// both sides.
Rgb8 blueWhiteRed(double position);

struct ColourBarText {
  std::string label = "distance to the surface [mm]";
  bool any_below = false, any_above = false;  // values beyond the range: an arrow at that end
  bool any_missing = false;                   // a grey patch beside the bar, and what it means
  std::string missing = "not observed";
};

/// A horizontal bar with numbers below and its label under them; `width_pt` of all of it. Returns
/// the height used.
double drawColourBar(const ErrorColours& colours, const ColourBarText& text, PointPt top_left,
                     double width_pt, double font_pt, VectorDrawing& drawing);

/// What drawColourBar() will use.
double colourBarHeightPt(double font_pt);

}  // namespace softscope
