// src/stereo/matching/sgbm_matcher.h: semi-global matching of OpenCV as a StereoMatcher.
#pragma once

#include "stereo/matching/stereo_matcher.h"

namespace softscope {

/// Semi-global block matching (Hirschmüller 2008) of OpenCV;
/// the alternative, and the reference for comparisons.
class SgbmMatcher final : public StereoMatcher {
 public:
  explicit SgbmMatcher(const StereoOptions& options) : options_(options) {}
  std::string name() const override { return "sgbm"; }
  using StereoMatcher::match;
  DisparityMap match(const GrayImage& left, const GrayImage& right,
                     const ViewMasks& ignored) override;
  const StageTimes& times() const override { return times_; }

 private:
  StereoOptions options_;
  StageTimes times_;
};

}  // namespace softscope
