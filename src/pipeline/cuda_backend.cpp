#include "pipeline/cuda_backend.h"

#include <utility>

#include "cuda/comparison/comparison.h"
#include "cuda/device/device_info.h"
#include "cuda/frame/survey.h"
#include "cuda/fusion/fusion.h"
#include "cuda/locate/locate.h"
#include "cuda/pose/pose.h"
#include "cuda/stereo/stereo.h"
#include "cuda/surface/surface.h"
#include "cuda/warp/model_warp.h"
#include "cuda/warp/warp.h"
#include "deform/solver/device_warp_system.h"
#include "pipeline/cpu_backend.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {
namespace {

class CudaStereoStage final : public StereoStage {
 public:
  /// Depth that stays on the device is told of by `measured`.
  CudaStereoStage(const StereoOptions& options, const RectifiedRig& rig,
                  std::shared_ptr<cuda::SharedRasters> measured)
      : device_(options, rig, rig.left.width_px, rig.left.height_px),
        method_(options.method),
        measured_(std::move(measured)) {}
  std::string name() const override { return method_; }
  MatchableViews prepare(const AlignedPair& aligned) const override {
    return matchableViews(toGray(aligned.pair.left), toGray(aligned.pair.right), aligned.ignored);
  }
  StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                        const Mask& mask) override;
  void drop(const Mask& mask, StereoSurface* measured) override {
    if (mask.empty()) return;
    measured->drop(mask);
    device_.drop(mask);
  }

 private:
  cuda::Stereo device_;
  std::string method_;
  std::shared_ptr<cuda::SharedRasters> measured_;
  bool is_masked_ = false;
};

StereoSurface CudaStereoStage::measure(const AlignedPair& aligned, const MatchableViews& prepared,
                                       const Mask& mask) {
  StageClock clock;
  if (is_masked_ || !mask.empty()) device_.setMask(mask);
  is_masked_ = !mask.empty();
  device_.upload(prepared);
  device_.compute(aligned.roll_rad);
  cuda::StereoDepth found = device_.download();
  *measured_ = device_.rasters();
  measured_->host_depth_mm = found.depth.depth_mm.values.data();
  clock.lap("disparity");
  return {std::move(found.disparity), std::move(found.depth), std::move(found.normals),
          clock.laps()};
}

class CudaMatchStage final : public MatchStage {
 public:
  CudaMatchStage(const ReconstructionOptions& options, const RectifiedRig& rig,
                 std::shared_ptr<const cuda::SharedRasters> rasters,
                 std::shared_ptr<cuda::SharedModel> model)
      : matcher_(options.matcher),
        view_(options.model_view),
        left_(rig.left),
        rasters_(std::move(rasters)),
        model_(std::move(model)) {
    reserve(static_cast<std::size_t>(left_.width_px) * static_cast<std::size_t>(left_.height_px) /
            4);
  }
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override;

 private:
  /// Memory of before is given back first, so that the old and the new never add up.
  void reserve(std::size_t points) {
    device_.reset();
    device_ = std::make_unique<cuda::Locator>(left_, view_, matcher_, static_cast<int>(points));
    capacity_ = points;
  }

  MatcherOptions matcher_;
  ModelViewOptions view_;
  PinholeCamera left_;
  std::shared_ptr<const cuda::SharedRasters> rasters_;
  std::shared_ptr<cuda::SharedModel> model_;
  std::size_t capacity_ = 0;
  std::unique_ptr<cuda::Locator> device_;
};

ModelMatches CudaMatchStage::match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                                   const GrayImage& seen_gray, const MatchPicture& live,
                                   const MeasuredFrame& frame, StageClock* clock) {
  // Twice the points at a time, so that a growing model rarely reallocates.
  if (model.size() > capacity_) reserve(2 * model.size());
  device_->setModel(model, *model_);
  if (rasters_->holds(frame.depth.depth_mm.values.data()))
    device_->setLive(*rasters_);
  else
    device_->setLive(live, frame.depth);
  device_->setSeenGray(seen_gray);
  device_->locate(viewed_from);
  cuda::LocatedMatches found = device_->download();
  clock->lap("match");
  return {std::move(found.pixels), std::move(found.lifted)};
}

/// Other methods have no kernels.
std::unique_ptr<MatchStage> makeCudaMatchStage(const ReconstructionOptions& options,
                                               const RectifiedRig& rig,
                                               std::shared_ptr<const cuda::SharedRasters> rasters,
                                               std::shared_ptr<cuda::SharedModel> model) {
  if (options.matcher.method != MatcherOptions::kDenseSurf) return makeCpuMatchStage(options, rig);
  return std::make_unique<CudaMatchStage>(options, rig, std::move(rasters), std::move(model));
}

/// Affine nodes have no kernels.
std::unique_ptr<DeformSolver> makeCudaSolver(const DeformOptions& options,
                                             std::shared_ptr<const cuda::SharedRasters> shared,
                                             std::shared_ptr<cuda::SharedModel> model) {
  if (options.node_model != NodeModel::kRigid) return makeDeformSolver(options);
  return makeDeformSolver(
      options,
      makeDeviceWarpSystem(options, cuda::makeWarpDevice(warpWeights(options), std::move(shared),
                                                         std::move(model))));
}

}  // namespace

std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions& options,
                                                 const RectifiedRig& rig) {
  return std::make_unique<CudaStereoStage>(options, rig, std::make_shared<cuda::SharedRasters>());
}

std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration& calibration,
                                                       const ReconstructionOptions& options) {
  BackendParts parts;
  parts.name = "cuda";
  // The model stays on the device between the stages.
  const auto model = cuda::makeSharedModel();
  // So does the frame, measured and at hand.
  const auto measured = std::make_shared<cuda::SharedRasters>();
  const auto rasters = std::make_shared<cuda::SharedRasters>();
  parts.makeStereo = [measured](const StereoOptions& options, const RectifiedRig& rig) {
    return std::make_unique<CudaStereoStage>(options, rig, measured);
  };
  parts.makeSurvey = [measured, rasters](const RectifiedRig& rig) {
    return cuda::makeFrameSurvey(rig.left, measured, rasters);
  };
  parts.makeMatching = [rasters, model](const ReconstructionOptions& all, const RectifiedRig& rig) {
    return makeCudaMatchStage(all, rig, rasters, model);
  };
  parts.makePoseSearch = cuda::makePoseSearch;
  parts.makeSolver = [rasters, model](const DeformOptions& warp) {
    return makeCudaSolver(warp, rasters, model);
  };
  parts.makeComparer = [rasters, model](const RectifiedRig& rig) {
    return cuda::makeFrameComparer(rig.left, rasters, model);
  };
  parts.makeUpdater = [rasters, model](const RectifiedRig& rig) {
    return cuda::makeModelUpdater(rig.left, rasters, model);
  };
  parts.makeWarp = [model] { return cuda::makeModelWarp(model); };
  parts.makeSurface = [model] { return cuda::makeSurfaceSearch(model); };
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (!info.devices.empty()) parts.device = info.devices.front().name;
  return makeCpuBackend(calibration, options, parts);
}

}  // namespace softscope
