// src/calibrate/view_choice.h: which images of a board a calibration uses.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/board.h"

namespace softscope {

/// The board in both images of one moment.
struct BoardSighting {
  int frame = 0;
  std::vector<BoardCorner> left, right;
  double edge_width_px = 0;  // of the blurrier view
};

struct ViewChoiceOptions {
  double blur_ratio = 1.6;     // edges wider than this times the sharp quarter's: blurred
  double least_shift_px = 10;  // corners moved less, on average, since a used view: doubled
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

/// Of alike views the sharpest is used; where too many remain, those most unlike each other.
ViewChoice chooseViews(const std::vector<BoardSighting>& sightings,
                       const ViewChoiceOptions& options = {});

}  // namespace softscope
