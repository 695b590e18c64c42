// cuda/locate/locate.h: the model found again in the live image, on the GPU.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/depth_map.h"
#include "core/point_model.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/model/shared_model.h"
#include "features/lift_matches.h"
#include "features/matcher.h"
#include "features/model_view.h"

namespace softscope::cuda {

/// Matches of the view with the live image, and those with depth on both sides.
struct LocatedMatches {
  std::vector<PixelMatch> pixels;
  std::vector<LiftedMatch> lifted;
};

/// Draws the model, matches its view and lifts the matches without leaving the device. The same
/// bytes as renderModelView(), the dense SURF matcher and liftMatches() give on the CPU.
class Locator {
 public:
  /// Throws BackendError without a device that runs this build, or with too little memory;
  /// OptionError where an option has no GPU version.
  Locator(const PinholeCamera& camera, const ModelViewOptions& view, const MatcherOptions& matcher,
          int point_capacity);
  ~Locator();
  Locator(const Locator&) = delete;
  Locator& operator=(const Locator&) = delete;

  /// Throws Error for more points than the capacity.
  void setModel(const PointModel& model);
  /// The same; copies what of it has changed on the host.
  void setModel(const PointModel& model, SharedModel& on_device);
  /// Throws InputError for another shape. `depth.sigma_mm` may be empty.
  void setLive(const MatchPicture& live, const DepthMap& depth);
  /// The same, of rasters on the device.
  void setLive(const SharedRasters& from);
  /// Seen from there, the model looked so; empty: as it is drawn.
  void setSeenGray(const GrayImage& gray);

  /// Returns when everything is enqueued; what it needs of model and image is copied by then.
  void locate(const Eigen::Isometry3d& world_from_left);
  void wait();
  LocatedMatches download();

  /// With stage times, kernels are launched one by one and locate() waits; without, as a graph.
  void timeStages(bool on);
  /// Of the last locate() with stage times: stage, ms.
  const std::vector<std::pair<std::string, double>>& stageTimes() const;

  std::size_t deviceBytes() const;

 private:
  class Device;
  std::unique_ptr<Device> device_;
};

}  // namespace softscope::cuda
