// src/pipeline/frame/frame_depth.h: stage 1, depth of one stereo frame.
#pragma once

#include <future>
#include <memory>
#include <string>

#include "core/depth_map.h"
#include "core/frame.h"
#include "core/stereo_rig.h"
#include "pipeline/frame/stereo_stage.h"
#include "pipeline/options/frame_depth_options.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// All rasters have the shape of the rectified left image.
struct MeasuredFrame {
  std::string method;  // elas, sgbm, onnx or files
  ColourImage left;    // rectified
  Mask mask;    // instruments, even border, pixels outside of the raw left image; may be empty
  Mask border;  // part of it known before matching; may be empty
  DisparityMap disparity;  // empty with depth from a file; may be in a reconstruction
  DepthMap depth;          // NaN under the mask
  NormalMap normals;
  RowAlignment rows;  // as measured after rectification
  bool rows_aligned = false;
  StageTimes times;
};

/// A frame before matching.
struct FrameViews {
  MeasuredFrame
      measured;         // all but disparity, depth and normals; whole where depth came from a file
  AlignedPair aligned;  // empty with depth from a file
  MatchableViews prepared;  // of them, by the stage
  Mask clipped;             // not measured; empty: none
  Mask instruments;         // mask file of the frame, rectified; empty without one

  const ColourImage& left() const {
    return aligned.pair.left.empty() ? measured.left : aligned.pair.left;
  }
  GrayImage leftGray() const {
    return aligned.pair.left.empty() ? toGray(measured.left) : aligned.left_gray;
  }
};

/// Rectifies, aligns rows, matches, converts to depth; or takes the depth of the sequence.
class FrameDepth {
 public:
  /// Throws OptionError for invalid options, InputError for an
  /// inconsistent calibration, and what `makeStage` throws.
  FrameDepth(const StereoCalibration& calibration, const FrameDepthOptions& options,
             const StereoStageFactory& makeStage = makeCpuStereoStage);

  const RectifiedRig& rig() const { return rectifier_.rig(); }
  const Rectifier& rectifier() const { return rectifier_; }

  /// Throws InputError for an inconsistent frame.
  MeasuredFrame measure(const Frame& frame) { return measure(viewsOf(frame)); }

  // The same in two halves. The first may run in parallel to the second of another frame.
  FrameViews viewsOf(const Frame& frame) const;
  MeasuredFrame measure(FrameViews views);
  /// Without normals where these are on their way from a device: then `normals` is valid.
  MeasuredFrame measure(FrameViews views, std::future<NormalMap>* normals);

 private:
  FrameViews align(const Frame& frame) const;
  void takeFile(const Frame& frame, MeasuredFrame& measured) const;
  bool takesFile(const Frame& frame) const;
  void requireRectified() const;

  FrameDepthOptions options_;
  std::string calibration_source_;
  bool rectified_;
  RowPlane rows_;  // expected
  Rectifier rectifier_;
  std::unique_ptr<StereoStage> stage_;
};

}  // namespace softscope
