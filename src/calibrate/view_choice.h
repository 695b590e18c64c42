// src/calibrate/view_choice.h: selection of the images of a board for a calibration.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/board.h"

namespace softscope {

/// Board in both images of one time.
struct BoardSighting {
  int frame = 0;
  std::vector<BoardCorner> left, right;
  double edge_width_px = 0;  // of the view with more blur
};

struct ViewChoiceOptions {
  double blur_ratio = 1.6;     // blurred: edges wider than this multiple of the first quartile
  double least_shift_px = 10;  // duplicate: corners moved less since a selected view
  int most_views = 60;

  /// Throws OptionError.
  void validate() const;
};

struct LeftOutView {
  int frame = 0;
  std::string why;  // "blurred: edges of 5.1 px, others 2.2 px", "as frame 12", …
};

struct ViewChoice {
  std::vector<std::size_t> used;  // indices of sightings, by frame
  std::vector<LeftOutView> left_out;
};

/// Of similar views the sharpest is selected; of too many, the most different ones.
ViewChoice chooseViews(const std::vector<BoardSighting>& sightings,
                       const ViewChoiceOptions& options = {});

}  // namespace softscope
