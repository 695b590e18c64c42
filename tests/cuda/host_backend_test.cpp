// tests/cuda/host_backend_test.cpp: a reconstruction whose stereo and matches come from the GPU's
// kernels, run on the host, gives the CPU's model.
#include <gtest/gtest.h>

#include "host_locate.h"
#include "host_stereo.h"
#include "pipeline/cpu_backend.h"
#include "tests/pipeline/short_clip.h"

namespace softscope::test {
namespace {

class StereoOnTheHost : public StereoStage {
 public:
  StereoOnTheHost(const StereoOptions& options, const RectifiedRig& rig)
      : stereo_(options, rig.left.width_px, rig.left.height_px, 5), rig_(rig) {}
  std::string name() const override { return "elas"; }
  StereoSurface measure(const AlignedPair& aligned, const Mask& mask) override {
    stereo_.compute(
        matchableViews(toGray(aligned.pair.left), toGray(aligned.pair.right), aligned.ignored),
        rig_, aligned.roll_rad, mask);
    const cuda::StereoLayout& found = stereo_.layout();
    StereoSurface surface;
    surface.disparity = {rasterOf(found.disparity), rasterOf(found.sigma)};
    surface.depth = {rasterOf(found.depth), rasterOf(found.depth_sigma)};
    surface.normals = NormalMap(found.normals.width, found.normals.height, Eigen::Vector3f::Zero());
    const Raster<cuda::NormalPixel> normals = rasterOf(found.normals);
    for (std::size_t i = 0; i < normals.size(); ++i)
      surface.normals.values[i] = {normals.values[i].x, normals.values[i].y, normals.values[i].z};
    return surface;
  }

 private:
  HostStereo stereo_;
  RectifiedRig rig_;
};

class MatchingOnTheHost : public MatchStage {
 public:
  MatchingOnTheHost(const ReconstructionOptions& options, const RectifiedRig& rig)
      : options_(options), left_(rig.left) {}
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override {
    cuda::LocatedMatches found =
        locateOnTheHost(left_, options_.model_view, options_.matcher, model, viewed_from, seen_gray,
                        live, frame.depth, 7);
    clock->lap("match");
    return {std::move(found.pixels), std::move(found.lifted)};
  }

 private:
  ReconstructionOptions options_;
  PinholeCamera left_;
};

std::string modelAfterThreeFrames(const BackendParts& parts) {
  const ShortClip& clip = shortClip();
  Reconstructor reconstructor(makeCpuBackend(clip.calibration, smallOptions(), parts),
                              smallOptions());
  for (std::size_t i = 0; i < 3; ++i) {
    Frame frame = clip.frames[i];
    if (i == 2) {  // one with an instrument
      frame.mask = Mask(240, 180, 0);
      for (int v = 40; v < 100; ++v) std::fill_n(frame.mask.row(v) + 90, 60, std::uint8_t{255});
    }
    EXPECT_TRUE(reconstructor.process(frame).fused());
  }
  return bytesOf(reconstructor.model().model);
}

TEST(HostBackend, KernelsGiveTheModelOfTheCpu) {
  BackendParts parts;
  parts.name = "cuda";
  parts.makeStereo = [](const StereoOptions& options, const RectifiedRig& rig) {
    return std::make_unique<StereoOnTheHost>(options, rig);
  };
  parts.makeMatching = [](const ReconstructionOptions& options, const RectifiedRig& rig) {
    return std::make_unique<MatchingOnTheHost>(options, rig);
  };
  EXPECT_TRUE(modelAfterThreeFrames(parts) == modelAfterThreeFrames({}));
}

}  // namespace
}  // namespace softscope::test
