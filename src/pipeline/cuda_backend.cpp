#include "pipeline/cuda_backend.h"

#include <utility>

#include "cuda/device_info.h"
#include "cuda/match.h"
#include "cuda/stereo.h"
#include "pipeline/cpu_backend.h"
#include "stereo/matching/host_prior.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {
namespace {

class CudaStereoStage final : public StereoStage {
 public:
  CudaStereoStage(const StereoOptions& options, const RectifiedRig& rig)
      : device_(options, rig, rig.left.width_px, rig.left.height_px, planePrior),
        cpu_(makeCpuStereoStage(options, rig)) {}
  std::string name() const override { return cpu_->name(); }
  StereoSurface measure(const AlignedPair& aligned, const Mask& mask) override;

 private:
  cuda::Stereo device_;
  std::unique_ptr<StereoStage> cpu_;
  bool is_masked_ = false;
};

StereoSurface CudaStereoStage::measure(const AlignedPair& aligned, const Mask& mask) {
  // No kernel keeps its windows off masked pixels yet.
  if (!aligned.ignored.left.empty() || !aligned.ignored.right.empty())
    return cpu_->measure(aligned, mask);
  StageClock clock;
  if (is_masked_ || !mask.empty()) device_.setMask(mask);
  is_masked_ = !mask.empty();
  device_.upload(aligned.pair.left, aligned.pair.right);
  device_.compute(aligned.roll_rad);
  cuda::StereoDepth found = device_.download();
  clock.lap("disparity");
  return {std::move(found.disparity), std::move(found.depth), std::move(found.normals),
          clock.laps()};
}

/// Other methods have no kernels.
std::unique_ptr<FeatureMatcher> makeCudaMatcher(const MatcherOptions& options,
                                                const RectifiedRig& rig) {
  if (options.method != "dense-surf") return makeFeatureMatcher(options);
  return std::make_unique<cuda::Matcher>(options, rig.left.width_px, rig.left.height_px);
}

}  // namespace

std::unique_ptr<StereoStage> makeCudaStereoStage(const StereoOptions& options,
                                                 const RectifiedRig& rig) {
  return std::make_unique<CudaStereoStage>(options, rig);
}

std::unique_ptr<ReconstructionBackend> makeCudaBackend(const StereoCalibration& calibration,
                                                       const ReconstructionOptions& options) {
  BackendParts parts;
  parts.name = "cuda";
  parts.makeStereo = makeCudaStereoStage;
  parts.makeMatcher = makeCudaMatcher;
  parts.depth_ahead_from_threads = 2;
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (!info.devices.empty()) parts.device = info.devices.front().name;
  return makeCpuBackend(calibration, options, parts);
}

}  // namespace softscope
