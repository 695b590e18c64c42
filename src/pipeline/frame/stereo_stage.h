// src/pipeline/frame/stereo_stage.h: depth and normals of a rectified pair with aligned rows.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>

#include "core/depth_map.h"
#include "core/rectified_rig.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// Of the left image, in its shape.
struct StereoSurface {
  DisparityMap disparity;
  DepthMap depth;
  NormalMap normals;
  StageTimes times;

  /// Removes measurements under `mask`, which may be empty.
  void drop(const Mask& mask);
};

/// Part of stage 1 that may run on another device. All implementations give the same bytes.
class StereoStage {
 public:
  virtual ~StereoStage() = default;
  /// Of the matcher, one of stereoMethods(); written to every report.
  virtual std::string name() const = 0;
  /// What measure() can be spared: made on any thread, also while it measures another pair.
  virtual MatchableViews prepare(const AlignedPair& /*aligned*/) const { return {}; }
  /// `prepared`: from prepare(). No disparity and no depth under `mask`, which may be empty.
  virtual StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                                const Mask& mask) = 0;
  /// Fetches the disparities of what was measured last, where measure() left them on a device.
  virtual void fetchDisparity(StereoSurface* /*measured*/) {}
  /// Removes measurements under `mask`, which may be empty, from what was measured last.
  virtual void drop(const Mask& mask, StereoSurface* measured) { measured->drop(mask); }
  /// Normals of what was measured last, where measure() left them on a device: copied on a thread,
  /// also while the next pair is measured. Else invalid.
  virtual std::future<NormalMap> fetchNormals() { return {}; }
};

using StereoStageFactory =
    std::function<std::unique_ptr<StereoStage>(const StereoOptions&, const RectifiedRig&)>;

/// On the CPU. Throws OptionError, InputError for an inconsistent network.
std::unique_ptr<StereoStage> makeCpuStereoStage(const StereoOptions& options,
                                                const RectifiedRig& rig);

}  // namespace softscope
