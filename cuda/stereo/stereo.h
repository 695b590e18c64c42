// cuda/stereo/stereo.h: stereo depth of rectified pairs on the GPU.
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/depth_map.h"
#include "core/image.h"
#include "core/rectified_rig.h"
#include "cuda/device/shared_rasters.h"
#include "stereo/images/view_masks.h"
#include "stereo/options/stereo_options.h"

namespace softscope::cuda {

/// Of the rectified left image; the same bytes as ElasMatcher, removeRoll(), depthFromDisparity(),
/// mask and normalsFromDepth() on the CPU; NaN in normals may have another payload.
struct StereoDepth {
  DisparityMap disparity;
  DepthMap depth;
  NormalMap normals;
  int levels = 0;  // of the pyramid that were needed
};

/// Stage for one image size; memory is allocated at construction.
/// One frame at a time: upload(), compute(), download().
class Stereo {
 public:
  /// Throws BackendError without a suitable device, or with too little memory;
  /// OptionError for an option without GPU version.
  Stereo(const StereoOptions& options, const RectifiedRig& rig, int width_px, int height_px);
  ~Stereo();
  Stereo(const Stereo&) = delete;
  Stereo& operator=(const Stereo&) = delete;

  /// Rectified, with aligned rows (matchableViews()). Throws InputError for another size.
  void upload(const MatchableViews& views);
  /// Pixels removed from the result. Empty: none. Valid for the following frames.
  void setMask(const Mask& mask);

  /// Asynchronous; returns before the end if one level of the pyramid is enough.
  void compute(double roll_rad = 0);
  void wait();
  StereoDepth download();
  /// The same in parts. Normals are copied on a thread, also while the next frame is computed.
  DepthMap downloadDepth();
  DisparityMap downloadDisparity();
  std::future<NormalMap> downloadNormals();
  /// Removes pixels from what was computed last; downloads before stay as they are.
  void drop(const Mask& mask);
  /// What was computed last; host_depth_mm is left to the caller.
  SharedRasters rasters() const;

  /// With stage times, kernels are launched one by one and compute() waits; otherwise as graphs.
  void timeStages(bool on);
  /// Of the last compute() with stage times: stage, ms.
  const std::vector<std::pair<std::string, double>>& stageTimes() const;

  std::size_t deviceBytes() const;

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace softscope::cuda
