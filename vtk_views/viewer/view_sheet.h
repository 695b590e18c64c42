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
inline constexpr int kSliderPx = 26;  // upper part of the foot, for the mouse

/// Content of the foot.
struct ViewFoot {
  std::vector<double> places;  // positions of the models on the slider, 0 to 1, ascending
  int index = 0;
  std::string title;                    // "frame 38, 1.52 s"
  std::string status;                   // "model 20 of 20, 59 645 points; paused"
  std::string view;                     // "seen from the scope"
  std::string going;                    // "live", "stopped"; empty: all models exist
  bool of_window = false;               // with content not needed in images: playback, keys
  std::optional<ErrorColours> colours;  // colour bar with its label
  ColourBarText bar;
  std::string colour;              // text without a bar
  double width_mm = std::nan("");  // field of view; NaN: no scale bar
};

/// Of a model of the source.
ViewFoot footOf(const ViewSource& source, const ViewMoment& moment, const Playback& playback,
                const ViewState& state, double width_mm, bool of_window);

/// kViewFootPx high; `scale` times as high,
/// with text and lines, for a larger image.
ColourImage drawViewFoot(const ViewFoot& foot, int width_px, double scale = 1);
/// Position on the slider of a pixel column, 0 to 1.
double sliderPlace(int x_px, int width_px);
/// Model nearest to a position on the slider.
int nearestMoment(const std::vector<double>& places, double place);

/// Table of keys on a white card.
ColourImage drawViewHelp();

/// `top` above `bottom` of equal width; an optional card centred in `top`.
ColourImage composeView(const ColourImage& top, const ColourImage& bottom, const ColourImage* card);

}  // namespace softscope
