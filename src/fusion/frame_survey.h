// src/fusion/frame_survey.h: statistics of depths, states of pixels and relief of a measured frame,
// on the device whose stages work on it next.
#pragma once

#include "core/image.h"
#include "fusion/observation.h"
#include "fusion/tissue_depths.h"

namespace softscope {

/// show(), depthsOf() and statesOf() are called in this order for each frame, on any thread, while
/// the stages work on a frame before. The camera's pose does not matter. All implementations give
/// the same bytes.
class FrameSurvey {
 public:
  virtual ~FrameSurvey() = default;
  /// Images of the frame whose depth is measured next: `gray` and `ignore` as it is matched. They
  /// stay as they are until statesOf() returns; so do the rasters of its depth.
  virtual void show(const ColourImage& left, const Mask& not_tissue, const GrayImage& gray,
                    const Mask& ignore) = 0;
  virtual TissueDepths depthsOf(const Observation& frame) = 0;
  virtual Raster<PixelState> statesOf(const Observation& frame, const PixelOptions& options) = 0;
  /// The stages work on the frame with that depth now, whose rasters stay where they are in memory
  /// until the next frame is used. One that was not surveyed last is copied by each stage that
  /// needs it.
  virtual void use(const DepthMap& depth) = 0;
  /// reliefErrorPx() of the frame in use, for `focal_baseline_px_mm`, the focal length times the
  /// baseline; empty: not found here. On any thread, while others are surveyed.
  virtual Raster<float> reliefOf(const DepthMap& depth, double focal_baseline_px_mm) = 0;
};

class CpuFrameSurvey final : public FrameSurvey {
 public:
  void show(const ColourImage& /*left*/, const Mask& /*not_tissue*/, const GrayImage& /*gray*/,
            const Mask& /*ignore*/) override {}
  TissueDepths depthsOf(const Observation& frame) override {
    return tissueDepths(frame.depth, frame.mask);
  }
  Raster<PixelState> statesOf(const Observation& frame, const PixelOptions& options) override {
    return classifyPixels(frame, options);
  }
  void use(const DepthMap& /*depth*/) override {}
  Raster<float> reliefOf(const DepthMap& /*depth*/, double /*focal_baseline_px_mm*/) override {
    return {};
  }
};

}  // namespace softscope
