#include "pipeline/cuda_backend.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "cuda/comparison/comparison.h"
#include "cuda/device/device_info.h"
#include "cuda/frame/survey.h"
#include "cuda/fusion/fusion.h"
#include "cuda/locate/locate.h"
#include "cuda/looks/looks.h"
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
  /// The depth stays on the device, in `frames`; disparities too, until they are asked for, unless
  /// `downloads_disparity`.
  CudaStereoStage(const StereoOptions& options, const RectifiedRig& rig,
                  std::shared_ptr<cuda::SharedFrames> frames, bool downloads_disparity)
      : device_(options, rig, rig.left.width_px, rig.left.height_px),
        method_(options.method),
        frames_(std::move(frames)),
        downloads_disparity_(downloads_disparity) {}
  std::string name() const override { return method_; }
  MatchableViews prepare(const AlignedPair& aligned) const override {
    return matchableViews(aligned.left_gray, aligned.right_gray, aligned.ignored);
  }
  StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                        const Mask& mask) override;
  void fetchDisparity(StereoSurface* measured) override {
    if (!downloads_disparity_) measured->disparity = device_.downloadDisparity();
  }
  void drop(const Mask& mask, StereoSurface* measured) override {
    if (mask.empty()) return;
    measured->drop(mask);
    device_.drop(mask);
  }
  std::future<NormalMap> fetchNormals() override { return device_.downloadNormals(); }

 private:
  cuda::Stereo device_;
  std::string method_;
  std::shared_ptr<cuda::SharedFrames> frames_;
  bool downloads_disparity_;
  bool is_masked_ = false;
};

StereoSurface CudaStereoStage::measure(const AlignedPair& aligned, const MatchableViews& prepared,
                                       const Mask& mask) {
  StageClock clock;
  if (is_masked_ || !mask.empty()) device_.setMask(mask);
  is_masked_ = !mask.empty();
  device_.upload(prepared);
  device_.compute(aligned.roll_rad);
  StereoSurface found;
  found.depth = device_.downloadDepth();
  if (downloads_disparity_) found.disparity = device_.downloadDisparity();
  frames_->measured = device_.rasters();
  frames_->measured.host_depth_mm = found.depth.depth_mm.values.data();
  clock.lap("disparity");
  found.times = clock.laps();
  return found;
}

class CudaMatchStage final : public MatchStage {
 public:
  CudaMatchStage(const ReconstructionOptions& options, const RectifiedRig& rig,
                 std::shared_ptr<const cuda::SharedFrames> frames,
                 std::shared_ptr<cuda::SharedModel> model)
      : matcher_(options.matcher),
        view_(options.model_view),
        left_(rig.left),
        frames_(std::move(frames)),
        model_(std::move(model)) {
    reserve(static_cast<std::size_t>(left_.width_px) * static_cast<std::size_t>(left_.height_px) /
            4);
  }
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override;
  bool begin(const PointModel& model, const Eigen::Isometry3d& viewed_from,
             const MatchPicture& live, const MeasuredFrame& frame) override {
    enqueue(model, viewed_from, {}, live, frame);
    return true;
  }
  ModelMatches take(StageClock* clock) override {
    cuda::LocatedMatches found = device_->download();
    clock->lap("match");
    return {std::move(found.pixels), std::move(found.lifted)};
  }

 private:
  void enqueue(const PointModel& model, const Eigen::Isometry3d& viewed_from,
               const GrayImage& seen_gray, const MatchPicture& live, const MeasuredFrame& frame);
  /// Where the rasters of a frame lie on the device, if they do.
  cuda::SharedRasters rastersOf(const float* depth_mm) const {
    return frames_->at_hand.holds(depth_mm) ? frames_->at_hand : frames_->find(depth_mm);
  }
  /// Memory of before is given back first, so that the old and the new never add up.
  void reserve(std::size_t points) {
    device_.reset();
    capacity_ = 0;
    device_ = std::make_unique<cuda::Locator>(left_, view_, matcher_, static_cast<int>(points));
    capacity_ = points;
  }

  MatcherOptions matcher_;
  ModelViewOptions view_;
  PinholeCamera left_;
  std::shared_ptr<const cuda::SharedFrames> frames_;
  std::shared_ptr<cuda::SharedModel> model_;
  std::size_t capacity_ = 0;
  std::unique_ptr<cuda::Locator> device_;
};

ModelMatches CudaMatchStage::match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                                   const GrayImage& seen_gray, const MatchPicture& live,
                                   const MeasuredFrame& frame, StageClock* clock) {
  enqueue(model, viewed_from, seen_gray, live, frame);
  return take(clock);
}

void CudaMatchStage::enqueue(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                             const GrayImage& seen_gray, const MatchPicture& live,
                             const MeasuredFrame& frame) {
  // Twice the points at a time, so that a growing model rarely reallocates.
  if (model.size() > capacity_) reserve(2 * model.size());
  device_->setModel(model, *model_);
  const float* depth_mm = frame.depth.depth_mm.values.data();
  if (const cuda::SharedRasters rasters = rastersOf(depth_mm); rasters.holds(depth_mm))
    device_->setLive(rasters);
  else
    device_->setLive(live, frame.depth);
  device_->setSeenGray(seen_gray);
  device_->locate(viewed_from);
}

/// Where the device fails the CPU answers: the next stage that needs the device says so.
class CudaLookStage final : public LookStage {
 public:
  explicit CudaLookStage(std::shared_ptr<const cuda::SharedFrames> frames)
      : device_(cuda::makeLookFinder()), frames_(std::move(frames)) {}
  bool takesPictures() const override { return false; }
  void changed() override { device_->forget(); }
  std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const FrameView& frame,
                              TrackPictures* pictures) override {
    const cuda::SharedRasters& rasters = frames_->at_hand;
    const bool is_there = rasters.holds(frame.measured.depth.depth_mm.values.data());
    try {
      return device_->find(sought, frame.live.gray, frame.live.ignore,
                           is_there ? &rasters : nullptr);
    } catch (const BackendError&) {
      device_->forget();
      return findLooks(sought, pictures->looks());
    }
  }

 private:
  std::unique_ptr<cuda::LookFinder> device_;
  std::shared_ptr<const cuda::SharedFrames> frames_;
};

/// Other methods have no kernels.
std::unique_ptr<MatchStage> makeCudaMatchStage(const ReconstructionOptions& options,
                                               const RectifiedRig& rig,
                                               std::shared_ptr<const cuda::SharedFrames> frames,
                                               std::shared_ptr<cuda::SharedModel> model) {
  if (options.matcher.method != MatcherOptions::kDenseSurf) return makeCpuMatchStage(options, rig);
  return std::make_unique<CudaMatchStage>(options, rig, std::move(frames), std::move(model));
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

/// The loops that are left to the host are short. More threads find nothing to do most of the time,
/// and look for it; of many cores, those that read images and work ahead need the other half
/// (docs/benchmarks.md).
std::shared_ptr<ThreadLimit> threadLimit(const PinholeCamera& image) {
  constexpr int kLeast = 4, kFewThreads = 8, kPixelsPerThread = 40000;
  const int enough = std::max(kFewThreads, image.width_px * image.height_px / kPixelsPerThread);
  const int half = std::max(threadCount() / 2, std::min(kLeast, threadCount()));
  return std::make_shared<ThreadLimit>(std::min(half, enough));
}

}  // namespace

std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions& options,
                                                 const RectifiedRig& rig) {
  return std::make_unique<CudaStereoStage>(options, rig, std::make_shared<cuda::SharedFrames>(),
                                           /*downloads_disparity=*/true);
}

std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration& calibration,
                                                       const ReconstructionOptions& options) {
  BackendParts parts;
  parts.name = "cuda";
  parts.thread_limit = threadLimit(calibration.left.pinhole);
  parts.ahead = {cuda::SharedFrames::kWaiting, 2 * cuda::SharedFrames::kWaiting};
  // The model stays on the device between the stages.
  const auto model = cuda::makeSharedModel();
  // So do the frames.
  const auto frames = std::make_shared<cuda::SharedFrames>();
  const std::shared_ptr<const cuda::SharedRasters> rasters(frames, &frames->at_hand);
  parts.makeStereo = [frames](const StereoOptions& options, const RectifiedRig& rig) {
    return std::make_unique<CudaStereoStage>(options, rig, frames, /*downloads_disparity=*/false);
  };
  parts.makeSurvey = [frames](const RectifiedRig& rig) {
    return cuda::makeFrameSurvey(rig.left, frames);
  };
  parts.makeMatching = [frames, model](const ReconstructionOptions& all, const RectifiedRig& rig) {
    return makeCudaMatchStage(all, rig, frames, model);
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
  parts.makeLooks = [frames] { return std::make_unique<CudaLookStage>(frames); };
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (!info.devices.empty()) parts.device = info.devices.front().name;
  return makeCpuBackend(calibration, options, parts);
}

}  // namespace softscope
