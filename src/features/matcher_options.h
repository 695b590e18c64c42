// src/features/matcher_options.h: options of matching and their defaults.
#pragma once

#include <string>
#include <vector>

#include "features/dense_surf.h"

namespace softscope {

/// Gauss-Newton on a window around each match, invariant to brightness gain and offset.
struct SubpixelOptions {
  std::string method = "gauss-newton";  // or "none"
  static constexpr int kRadiusPx = 7;   // window is (2 r + 1)², at most 15²
  static constexpr int kIterations = 8;
  static constexpr double kMaxShiftPx = 3.0;     // from the initial position
  static constexpr double kMinSimilarity = 0.7;  // correlation of both windows
  // predicted standard error of a match; a match with a
  // larger one is removed unless it is below the median …
  static constexpr double kMaxSigmaPx = 0.3;
  // … or below this one, and the only kind in its square of MatcherOptions::kCoarseSpacingPx
  static constexpr double kMaxLoneSigmaPx = 0.5;
  static constexpr double kFloorSigmaPx = 0.03;  // error independent of texture
  // in addition, if only the present appearance of the model is matched
  static constexpr double kDriftPx = 0.1;
};

/// Neighbours that must move like a match.
struct ConsistencyOptions {
  static constexpr double kReachPx = 20;  // radius of the neighbourhood on the model
  static constexpr double kAgreePx =
      2;                    // they agree if their shifts differ by no more than this, …
  double max_strain = 0.2;  // … and this share of their distance: tissue stretches
  static constexpr double kMinShare = 0.4;  // of the neighbours that must agree; 0 = no test
};

/// Names of all matchers: values of the setting matcher.method.
std::vector<std::string> matcherMethods();

struct MatcherOptions {
  static constexpr const char* kDenseSurf = "dense-surf";
  static constexpr const char* kSift = "sift";
  static constexpr const char* kDisFlow = "dis-flow";
  static constexpr const char* kNoMatches = "surf-off";

  std::string method = kDenseSurf;               // one of matcherMethods()
  double reach = 0.2;                            // shifts are below this share of the longer side
  static constexpr double kSearchRadiusPx = 12;  // around the prediction of the coarser level
  // squares of this size without a match use a coarser level
  static constexpr int kCoarseSpacingPx = 12;
  static constexpr double kMaxRatio = 0.9;   // best distance over the best one elsewhere
  static constexpr double kElsewherePx = 6;  // what is nearer to the best place isn't elsewhere
  static constexpr double kMutualPx = 3;     // maximum distance of the reverse match
  // of the matches that are kept: the most distinct per square
  static constexpr int kSpacingPx = 6;
  static constexpr int kDarkestGray = 10;  // darker pixels are left out …
  static constexpr int kDarkMarginPx = 3;  // … and those this close to them
  DenseSurfOptions dense_surf;
  SubpixelOptions subpixel;
  ConsistencyOptions consistency;             // of dense SURF and of flow
  static constexpr int kSiftFeatures = 4000;  // strongest key points of SIFT per image

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

}  // namespace softscope
