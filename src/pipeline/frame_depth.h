// src/pipeline/frame_depth.h: stage 1, one stereo frame to depth.
#pragma once

#include <memory>
#include <string>

#include "core/depth_map.h"
#include "core/frame.h"
#include "core/stereo_rig.h"
#include "pipeline/stereo_stage.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// Where depth comes from.
struct FrameDepthOptions {
  std::string source =
      "auto";               // the sequence's own depth/ where there is one; or "stereo", "files"
  bool align_rows = true;   // remove a residual row error where it is large enough
  bool find_border = true;  // mask the black border of the views
  StereoOptions stereo;

  /// Throws OptionError.
  void validate() const;
};

/// All rasters have the shape of the rectified left image.
struct MeasuredFrame {
  std::string method;  // elas, sgbm, onnx or files
  ColourImage left;    // rectified
  Mask mask;    // instruments, black border, what the raw left image does not show; may be empty
  Mask border;  // of these, what was known before matching; may be empty
  DisparityMap disparity;  // empty where depth came from a file
  DepthMap depth;          // NaN under the mask
  NormalMap normals;
  RowAlignment rows;  // as found after rectification
  bool rows_aligned = false;
  StageTimes times;
};

/// A frame before it is matched.
struct FrameViews {
  MeasuredFrame
      measured;         // all but disparity, depth and normals; whole where depth came from a file
  AlignedPair aligned;  // empty there
  Mask instruments;     // of the frame's own mask, rectified; empty where it has none
};

/// Rectify, align rows, match, lift; or take the depth that the sequence brings.
class FrameDepth {
 public:
  /// Throws OptionError for bad options, InputError where the calibration doesn't fit them, and
  /// what `makeStage` throws.
  FrameDepth(const StereoCalibration& calibration, const FrameDepthOptions& options,
             const StereoStageFactory& makeStage = makeCpuStereoStage);

  const RectifiedRig& rig() const { return rectifier_.rig(); }
  const Rectifier& rectifier() const { return rectifier_; }

  /// Throws InputError where the frame doesn't fit.
  MeasuredFrame measure(const Frame& frame) { return measure(viewsOf(frame)); }

  // The same in two halves. The first may run beside the second of another frame.
  FrameViews viewsOf(const Frame& frame) const;
  MeasuredFrame measure(FrameViews views);

 private:
  FrameViews align(const Frame& frame) const;
  void takeFile(const Frame& frame, MeasuredFrame& measured) const;
  bool takesFile(const Frame& frame) const;
  void requireRectified() const;

  FrameDepthOptions options_;
  std::string calibration_source_;
  bool rectified_;
  Rectifier rectifier_;
  std::unique_ptr<StereoStage> stage_;
};

}  // namespace softscope
