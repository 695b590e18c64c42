// src/features/matcher_options.h: options of matching and their defaults.
#pragma once

#include <string>

#include "features/dense_surf.h"

namespace softscope {

/// Gauss-Newton on a window around each match, invariant to brightness gain and offset.
struct SubpixelOptions {
  std::string method = "gauss-newton";  // or "none"
  static constexpr int kRadiusPx = 7;   // window is (2 r + 1)², at most 15²
  static constexpr int kIterations = 8;
  static constexpr double kMaxShiftPx = 3.0;     // from where it began
  static constexpr double kMinSimilarity = 0.7;  // correlation of both windows
  // predicted standard error of a match; a larger one is dropped unless it is below the image's
  // median
  static constexpr double kMaxSigmaPx = 0.3;
  static constexpr double kFloorSigmaPx = 0.03;  // error that no amount of texture removes
  // added to it where the model no longer looks as it first did
  static constexpr double kDriftPx = 0.1;
};

/// Neighbours that a match must move with.
struct ConsistencyOptions {
  static constexpr double kReachPx = 20;  // others this near on the model are its neighbours
  static constexpr double kAgreePx =
      2;                    // they agree if their shifts differ by no more than this, …
  double max_strain = 0.2;  // … and this share of their distance: tissue stretches
  static constexpr double kMinShare = 0.4;  // of the neighbours that must agree; 0 = no test
};

struct MatcherOptions {
  std::string method = "dense-surf";             // or "sift", "dis-flow", or "surf-off": no matches
  double reach = 0.2;                            // longest shift, share of the image's longer side
  static constexpr double kSearchRadiusPx = 12;  // around the shift that the coarser level predicts
  // squares of this size without a match take a coarser level's
  static constexpr int kCoarseSpacingPx = 12;
  static constexpr double kMaxRatio = 0.9;   // best distance over the best one elsewhere
  static constexpr double kElsewherePx = 6;  // what is nearer to the best place isn't elsewhere
  static constexpr double kMutualPx = 3;     // the match back ends this near to where it began
  // of the matches that are kept: one, the most distinct, a square
  static constexpr int kSpacingPx = 6;
  static constexpr int kDarkestGray = 10;  // darker pixels are left out …
  static constexpr int kDarkMarginPx = 3;  // … and those this near to them
  DenseSurfOptions dense_surf;
  SubpixelOptions subpixel;
  ConsistencyOptions consistency;             // of dense SURF and of flow
  static constexpr int kSiftFeatures = 4000;  // strongest key points that SIFT keeps an image

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

}  // namespace softscope
