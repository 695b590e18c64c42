// src/pipeline/stereo_stage.h: from a rectified pair with aligned rows to depth and normals.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/depth_map.h"
#include "core/rectified_rig.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// Of the left image, in its shape.
struct StereoSurface {
  DisparityMap disparity;
  DepthMap depth;
  NormalMap normals;
  StageTimes times;

  /// Nothing was measured under `mask`, which may be empty.
  void drop(const Mask& mask);
};

/// What of stage 1 may run on another device. Every implementation gives the same bytes.
class StereoStage {
 public:
  virtual ~StereoStage() = default;
  /// Of the matcher, one of stereoMethods(); written into every report.
  virtual std::string name() const = 0;
  /// No disparity and no depth under `mask`, which may be empty.
  virtual StereoSurface measure(const AlignedPair& aligned, const Mask& mask) = 0;
};

using StereoStageFactory =
    std::function<std::unique_ptr<StereoStage>(const StereoOptions&, const RectifiedRig&)>;

/// On the processor's cores. Throws OptionError, InputError where a network doesn't fit.
std::unique_ptr<StereoStage> makeCpuStereoStage(const StereoOptions& options,
                                                const RectifiedRig& rig);

}  // namespace softscope
