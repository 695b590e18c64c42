// tests/cuda/host_stereo.h: the kernels of stereo, run by the host executor.
#pragma once

#include <algorithm>
#include <vector>

#include "core/depth_map.h"
#include "core/image.h"
#include "cuda/device/host_executor.h"
#include "cuda/stereo/coarser_levels.h"
#include "cuda/stereo/stereo_passes.h"
#include "host_memory.h"
#include "stereo/images/view_masks.h"

namespace softscope::test {

class HostStereo {
 public:
  HostStereo(const StereoOptions& options, int width, int height, unsigned seed)
      : executor_(seed),
        memory_(bytesFor(options, width, height)),
        arena_(memory_.data()),
        layout_(arena_, options, width, height),
        passes_(executor_, layout_) {
    passes_.initialise();
  }

  /// All levels, then depth and normals.
  void compute(const MatchableViews& views, const RectifiedRig& rig, double roll_rad = 0,
               const Mask& mask = {}) {
    const cuda::StereoLevel& full = layout_.levels.front();
    copy(views.left, views.ignored.left, full, 0);
    copy(views.right, views.ignored.right, full, 1);
    std::copy(mask.values.begin(), mask.values.end(), layout_.mask.data);
    const auto level = [&](int k) -> const cuda::StereoLevel& {
      return layout_.levels[static_cast<std::size_t>(k)];
    };
    *layout_.inputs = {roll_rad, mask.empty() ? 0 : 1};
    matchLevel(full);
    levels_run_ = cuda::runCoarserLevels(
        layout_, [&](int k) { return level(k).counters->share; },
        [&](int k) {
          passes_.halve(level(k - 1), level(k));
          matchLevel(level(k));
        },
        [&](int k) { passes_.fillFromHalf(level(k + 1), level(k)); });
    passes_.finish(rig);
  }

  const cuda::StereoLayout& layout() const { return layout_; }
  int levelsRun() const { return levels_run_; }

 private:
  static void copy(const GrayImage& gray, const Mask& ignored, const cuda::StereoLevel& level,
                   int view) {
    std::copy(gray.values.begin(), gray.values.end(), level.gray[view].data);
    std::fill_n(level.ignored[view].data, gray.size(), std::uint8_t{0});
    std::transform(ignored.values.begin(), ignored.values.end(), level.ignored[view].data,
                   cuda::ignoredBits);
  }
  void matchLevel(const cuda::StereoLevel& level) {
    passes_.matchLevel(level);
    passes_.measureShare(level);
  }
  static std::size_t bytesFor(const StereoOptions& options, int width, int height) {
    cuda::Arena counting;
    cuda::StereoLayout(counting, options, width, height);
    return counting.bytes();
  }

  cuda::HostExecutor executor_;
  HostMemory memory_;
  cuda::Arena arena_;
  cuda::StereoLayout layout_;
  cuda::StereoPasses<cuda::HostExecutor> passes_;
  int levels_run_ = 0;
};

template <class T>
Raster<T> rasterOf(const cuda::View<T>& view) {
  Raster<T> raster(view.width, view.height);
  for (int v = 0; v < view.height; ++v)
    std::copy(view.row(v), view.row(v) + view.width, raster.row(v));
  return raster;
}

}  // namespace softscope::test
