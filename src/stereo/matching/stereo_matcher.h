// src/stereo/matching/stereo_matcher.h: interface of stereo matchers.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/depth_map.h"
#include "core/image.h"
#include "stereo/images/view_masks.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Stage and milliseconds, in the order of work.
using StageTimes = std::vector<std::pair<std::string, double>>;

/// Finds the disparity of each pixel of the rectified left image.
class StereoMatcher {
 public:
  virtual ~StereoMatcher() = default;

  /// One of stereoMethods(); written to every report.
  virtual std::string name() const = 0;

  /// Both images rectified and of one shape, otherwise Error. Result: shape of the left image,
  /// NaN without a match. Same input, same bytes, for any number of threads. No matching
  /// window reaches `ignored` pixels of its own view, and those of the left have no disparity.
  virtual DisparityMap match(const GrayImage& left, const GrayImage& right,
                             const ViewMasks& ignored) = 0;
  DisparityMap match(const GrayImage& left, const GrayImage& right) {
    return match(left, right, {});
  }

  /// Whether matchColour() is more than match() of the images' luma.
  virtual bool usesColour() const { return false; }
  virtual DisparityMap matchColour(const StereoPair& pair, const ViewMasks& ignored) {
    return match(toGray(pair.left), toGray(pair.right), ignored);
  }

  /// Work that can take long or fail, before the first pair of this size. Throws InputError.
  virtual void prepare(int /*width_px*/, int /*height_px*/) {}

  /// Of the last match().
  virtual const StageTimes& times() const = 0;
};

constexpr int kSmallestPicturePx = 32;

/// Throws InputError unless both images have one shape, at least kSmallestPicturePx each way.
void requireRectifiedPair(const GrayImage& left, const GrayImage& right);

/// Throws OptionError for invalid options, InputError for an unreadable network.
std::unique_ptr<StereoMatcher> makeStereoMatcher(const StereoOptions& options);

}  // namespace softscope
