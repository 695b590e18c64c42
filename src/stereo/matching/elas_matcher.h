// src/stereo/matching/elas_matcher.h: Efficient Large-scale Stereo (Geiger, Roser, Urtasun, ACCV
// 2010).
#pragma once

#include "stereo/matching/stereo_matcher.h"

namespace softscope {

class ElasMatcher final : public StereoMatcher {
 public:
  explicit ElasMatcher(const StereoOptions& options) : options_(options) {}
  std::string name() const override { return "elas"; }
  using StereoMatcher::match;
  DisparityMap match(const GrayImage& left, const GrayImage& right,
                     const ViewMasks& ignored) override;
  const StageTimes& times() const override { return times_; }

 private:
  StereoOptions options_;
  StageTimes times_;
};

}  // namespace softscope
