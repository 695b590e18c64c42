// src/features/matcher.h: dense matching of the model view to the live image.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "features/matcher_options.h"

namespace softscope {

/// Image to be matched, with its mask.
struct MatchPicture {
  GrayImage gray;
  Mask ignore;         // empty, or the image's shape; non-zero = no tissue, instrument, highlight
  GrayImage anchor{};  // empty, or reference intensities of the first observation
};

/// Match of two pixels.
struct PixelMatch {
  Eigen::Vector2f model_px;
  Eigen::Vector2f live_px;
  float sigma_px = 0;    // predicted standard error of live_px along its worst direction
  float similarity = 0;  // correlation of the windows, -1 to 1; 0 if not computed
};

class FeatureMatcher {
 public:
  virtual ~FeatureMatcher() = default;

  /// One of matcherMethods(); written into every report.
  virtual std::string name() const = 0;

  /// Matches inside both images, by rows of the model image. Images
  /// without texture, or fully ignored, give no matches. Deterministic
  /// for any number of threads. Throws Error for different sizes.
  virtual std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) = 0;
};

/// Throws OptionError for invalid options.
std::unique_ptr<FeatureMatcher> makeFeatureMatcher(const MatcherOptions& options);

}  // namespace softscope
