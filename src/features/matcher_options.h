// src/features/matcher_options.h: how pixels of the model view are found again; every default.
#pragma once

#include <string>

#include "features/dense_surf.h"

namespace softscope {

/// Gauss-Newton on a window around each match; blind to gain and offset of the brightness.
struct SubpixelOptions {
  std::string method = "gauss-newton";  // or "parabola" (dense SURF only), or "none"
  int radius_px = 7;                    // window is (2 r + 1)², at most 15²
  int iterations = 8;
  double max_shift_px = 3.0;     // from where it began
  double min_similarity = 0.7;   // correlation of both windows
  double max_sigma_px = 0.3;     // predicted standard error of a match; a larger one is dropped
                                 // unless it is below the image's median
  double floor_sigma_px = 0.03;  // error that no amount of texture removes
  double drift_px = 0.1;         // added to it where the model no longer looks as it first did
};

/// Neighbours that a match must move with.
struct ConsistencyOptions {
  double reach_px = 20;     // others this near on the model are its neighbours
  double agree_px = 2;      // they agree if their shifts differ by no more than this, …
  double max_strain = 0.2;  // … and this share of their distance: tissue stretches
  double min_share = 0.4;   // of the neighbours that must agree; 0 = no test
};

struct MatcherOptions {
  std::string method = "dense-surf";  // or "sift", "dis-flow", or "surf-off": no matches
  double reach = 0.2;                 // longest shift, share of the image's longer side
  double search_radius_px = 12;       // around the shift that the coarser level predicts
  int coarse_spacing_px = 12;         // squares of this size without a match take a coarser level's
  double max_ratio = 0.9;             // best distance over the best one elsewhere
  double elsewhere_px = 6;            // what is nearer to the best place isn't elsewhere
  double mutual_px = 3;               // the match back ends this near to where it began
  int spacing_px = 6;      // of the matches that are kept: one, the most distinct, a square
  int darkest_gray = 10;   // darker pixels are left out …
  int dark_margin_px = 3;  // … and those this near to them
  DenseSurfOptions dense_surf;
  SubpixelOptions subpixel;
  ConsistencyOptions consistency;  // of dense SURF and of flow
  int sift_features = 4000;        // strongest key points that SIFT keeps a picture

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

}  // namespace softscope
