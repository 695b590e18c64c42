// vtk_views/viewer/view_sheet.h: time line, legend and keys below a view.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/viewer/view_controls.h"

namespace softscope {

inline constexpr int kViewFootPx = 88;
inline constexpr int kSliderPx = 26;  // its upper part, where the mouse moves in time

/// What the foot says.
struct ViewFoot {
  std::vector<double> places;  // of the moments on the slider, 0 to 1, rising
  int index = 0;
  std::string title;                    // "frame 38, 1.52 s"
  std::string status;                   // "model 20 of 20, 59 645 points; paused"
  std::string view;                     // "seen from the scope"
  std::string going;                    // "live", "stopped"; empty: all moments are there
  bool of_window = false;               // says what an image needn't: playing, keys
  std::optional<ErrorColours> colours;  // a bar, and what it says
  ColourBarText bar;
  std::string colour;              // what is said where there is no bar
  double width_mm = std::nan("");  // that the view shows: a scale bar where it is known
};

/// Of a moment of the source.
ViewFoot footOf(const ViewSource& source, const ViewMoment& moment, const Playback& playback,
                const ViewState& state, double width_mm, bool of_window);

/// kViewFootPx high; of an image that is larger than a window `scale` times as high, with its
/// letters and lines.
ColourImage drawViewFoot(const ViewFoot& foot, int width_px, double scale = 1);
/// Where on the slider a pixel's column lies, 0 to 1.
double sliderPlace(int x_px, int width_px);
/// The moment nearest to a place on the slider.
int nearestMoment(const std::vector<double>& places, double place);

/// Keys and their meanings on a white card.
ColourImage drawViewHelp();

/// `top` above `bottom`, which is as wide; the card, if any, in the middle of `top`.
ColourImage composeView(const ColourImage& top, const ColourImage& bottom, const ColourImage* card);

}  // namespace softscope
