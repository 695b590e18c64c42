// src/stereo/matching/onnx_matcher.h: disparity by a network of the user, as a StereoMatcher.
#pragma once

#include "stereo/matching/stereo_matcher.h"
#include "stereo/networks/disparity_network.h"

namespace softscope {

/// Three passes of a network: the pair, the mirrored pair for the right image's disparity, and the
/// pair at half size. Their agreement gives the predicted standard error (docs/stereo.md, 8).
class OnnxMatcher final : public StereoMatcher {
 public:
  /// Throws InputError.
  explicit OnnxMatcher(const StereoOptions& options);
  std::string name() const override { return "onnx"; }
  using StereoMatcher::match;
  DisparityMap match(const GrayImage& left, const GrayImage& right,
                     const ViewMasks& ignored) override;
  bool usesColour() const override { return true; }
  DisparityMap matchColour(const StereoPair& pair, const ViewMasks& ignored) override;
  void prepare(int width_px, int height_px) override;
  const StageTimes& times() const override { return times_; }

 private:
  StereoOptions options_;
  DisparityNetwork network_;
  StageTimes times_;
};

}  // namespace softscope
