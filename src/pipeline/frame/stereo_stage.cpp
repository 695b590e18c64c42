#include "pipeline/frame/stereo_stage.h"

#include <limits>
#include <utility>

#include "stereo/depth/depth_from_disparity.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {
namespace {

class CpuStereoStage final : public StereoStage {
 public:
  CpuStereoStage(const StereoOptions& options, const RectifiedRig& rig)
      : matcher_(makeStereoMatcher(options)), rig_(rig) {
    matcher_->prepare(rig.left.width_px, rig.left.height_px);
  }
  std::string name() const override { return matcher_->name(); }
  StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                        const Mask& mask) override;

 private:
  std::unique_ptr<StereoMatcher> matcher_;
  RectifiedRig rig_;
};

StereoSurface CpuStereoStage::measure(const AlignedPair& aligned,
                                      const MatchableViews& /*prepared*/, const Mask& mask) {
  StageClock clock;
  StereoSurface found;
  found.disparity = matcher_->usesColour()
                        ? matcher_->matchColour(aligned.pair, aligned.ignored)
                        : matcher_->match(aligned.left_gray, aligned.right_gray, aligned.ignored);
  removeRoll(aligned.roll_rad, &found.disparity.disparity_px);
  clock.lap("disparity");
  found.depth = depthFromDisparity(found.disparity, rig_);
  found.drop(mask);
  clock.lap("depth");
  found.normals = normalsFromDepth(found.depth.depth_mm, rig_.left);
  clock.lap("normals");
  found.times = clock.laps();
  for (const auto& [stage, elapsed_ms] : matcher_->times())
    found.times.emplace_back("disparity/" + stage, elapsed_ms);
  return found;
}

}  // namespace

void StereoSurface::drop(const Mask& mask) {
  for (Raster<float>* raster :
       {&disparity.disparity_px, &disparity.sigma_px, &depth.depth_mm, &depth.sigma_mm})
    dropMasked(mask, raster);
  if (!normals.sameShape(mask)) return;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask.values[i] != 0) normals.values[i].setConstant(std::numeric_limits<float>::quiet_NaN());
}

std::unique_ptr<StereoStage> makeCpuStereoStage(const StereoOptions& options,
                                                const RectifiedRig& rig) {
  return std::make_unique<CpuStereoStage>(options, rig);
}

}  // namespace softscope
