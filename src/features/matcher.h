// src/features/matcher.h: dense matching of the model view to the live image.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "features/matcher_options.h"

namespace softscope {

/// An image to be matched, and what of it to leave out.
struct MatchPicture {
  GrayImage gray;
  Mask ignore;         // empty, or the image's shape; non-zero = no tissue, instrument, highlight
  GrayImage anchor{};  // empty, or how the same tissue looked when it was first seen
};

/// One piece of tissue in two images.
struct PixelMatch {
  Eigen::Vector2f model_px;
  Eigen::Vector2f live_px;
  float sigma_px = 0;    // predicted standard error of live_px along its worst direction
  float similarity = 0;  // correlation of the windows, -1 to 1; 0 where none was computed
};

class FeatureMatcher {
 public:
  virtual ~FeatureMatcher() = default;

  /// "dense-surf", "sift", "dis-flow" or "surf-off"; written into every report.
  virtual std::string name() const = 0;

  /// Matches inside both images, by rows of the model image. Images without texture, or all
  /// ignored, give no matches. Same input, same matches, whatever the number of threads. Throws
  /// Error where shapes differ.
  virtual std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) = 0;
};

/// Throws OptionError if the options break a rule.
std::unique_ptr<FeatureMatcher> makeFeatureMatcher(const MatcherOptions& options);

}  // namespace softscope
