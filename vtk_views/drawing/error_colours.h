// vtk_views/drawing/error_colours.h: colours of errors, and their colour bar.
#pragma once

#include <string>

#include "core/image.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Common range for all maps of a comparison.
struct ErrorColours {
  bool with_sign = false;  // viridis from 0 to limit, or blue-white-red from -limit to limit
  double limit_mm = 1;     // above 0

  double low_mm() const { return with_sign ? -limit_mm : 0; }
  /// Clamped to the range. NaN: kUnmeasuredGrey.
  Rgb8 colour(double error_mm) const;
};

/// Blue below 0, white at 0, red above; `position` from -1
/// to 1, clamped. Lightness falls evenly on both sides.
Rgb8 blueWhiteRed(double position);

struct ColourBarText {
  std::string label = "distance to the surface [mm]";
  bool any_below = false, any_above = false;  // values outside of the range: arrow at that end
  bool any_missing = false;                   // grey patch next to the bar, with its meaning
  std::string missing = "not observed";
};

/// Horizontal bar, numbers and label below it;
/// `width_pt` of all of it. Returns the used height.
double drawColourBar(const ErrorColours& colours, const ColourBarText& text, PointPt top_left,
                     double width_pt, double font_pt, VectorDrawing& drawing);

/// Height used by drawColourBar().
double colourBarHeightPt(double font_pt);

}  // namespace softscope
