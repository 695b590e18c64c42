// tests/cuda/host_backend_test.cpp: a reconstruction whose stages come from the GPU's kernels, run
// on the host, gives the CPU's model.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/comparison/comparison_run.h"
#include "cuda/frame/survey_run.h"
#include "cuda/fusion/fusion_run.h"
#include "cuda/looks/looks_run.h"
#include "cuda/warp/model_warp_run.h"
#include "host_locate.h"
#include "host_machine.h"
#include "host_stereo.h"
#include "pipeline/checkpoint.h"
#include "pipeline/cpu_backend.h"
#include "tests/pipeline/short_clip.h"

namespace softscope::test {
namespace {

class StereoOnTheHost : public StereoStage {
 public:
  StereoOnTheHost(const StereoOptions& options, const RectifiedRig& rig)
      : stereo_(options, rig.left.width_px, rig.left.height_px, 5), rig_(rig) {}
  std::string name() const override { return "elas"; }
  MatchableViews prepare(const AlignedPair& aligned) const override {
    return matchableViews(aligned.left_gray, aligned.right_gray, aligned.ignored);
  }
  StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                        const Mask& mask) override {
    stereo_.compute(prepared, rig_, aligned.roll_rad, mask);
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

class LooksOnTheHost : public LookStage {
 public:
  explicit LooksOnTheHost(unsigned seed) : kernels_(seed) {}
  bool takesPictures() const override { return false; }
  void changed() override { kernels_.forget(); }
  std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const FrameView& frame,
                              TrackPictures* /*pictures*/) override {
    return kernels_.find(sought, frame.live.gray, frame.live.ignore, nullptr);
  }

 private:
  cuda::LooksRun<HostMachine> kernels_;
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

/// Comparison, warp and fusion by kernels, with the model in one place.
BackendParts partsWithModelOnTheDevice(unsigned seed) {
  BackendParts parts;
  parts.name = "cuda";
  const auto home = std::make_shared<cuda::ModelHome<HostMachine>>();
  const auto frames = std::make_shared<cuda::SharedFrames>();
  const std::shared_ptr<const cuda::SharedRasters> rasters(frames, &frames->at_hand);
  parts.ahead = {cuda::SharedFrames::kWaiting, 2 * cuda::SharedFrames::kWaiting};
  parts.makeSurvey = [=](const RectifiedRig& rig) {
    return std::make_unique<cuda::SurveyRun<HostMachine>>(rig.left, frames, seed + 3);
  };
  parts.makeComparer = [=](const RectifiedRig& rig) {
    auto comparer = std::make_unique<cuda::ComparisonRun<HostMachine>>(rig.left, seed);
    comparer->share(rasters);
    comparer->share(home);
    return comparer;
  };
  parts.makeLooks = [=] { return std::make_unique<LooksOnTheHost>(seed + 4); };
  parts.makeWarp = [=] {
    return std::make_unique<cuda::ModelWarpRun<HostMachine>>(home, seed + 2);
  };
  parts.makeUpdater = [=](const RectifiedRig& rig) {
    auto updater = std::make_unique<cuda::FusionRun<HostMachine>>(rig.left, seed + 1);
    updater->share(rasters);
    updater->share(home);
    return updater;
  };
  return parts;
}

Reconstructor reconstructorOf(const BackendParts& parts) {
  Reconstructor made(makeCpuBackend(shortClip().calibration, smallOptions(), parts),
                     smallOptions());
  made.track(shortClip().seeds);
  return made;
}

void run(Reconstructor& reconstructor, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    EXPECT_TRUE(reconstructor.process(shortClip().frames[i]).fused());
}

/// Points further than 0.003 mm from those with about the same place in the other model.
int pointsApart(const PointModel& found, const PointModel& expected) {
  constexpr std::size_t kAround = 30;
  int apart = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    bool is_near = false;
    for (std::size_t k = i < kAround ? 0 : i - kAround;
         k < std::min(expected.size(), i + kAround) && !is_near; ++k)
      is_near = (found.positions_mm[i] - expected.positions_mm[k]).norm() <= 0.003F;
    apart += !is_near;
  }
  return apart;
}

TEST(HostBackend, ModelOnTheDeviceIsThatOfTheCpuAndGoesThroughCheckpoints) {
  Reconstructor cpu = reconstructorOf({}), whole = reconstructorOf(partsWithModelOnTheDevice(1));
  run(cpu, 0, 4);
  run(whole, 0, 4);
  const PointModel &expected = cpu.model().model, &found = whole.model().model;
  // Sums and the warp are rounded otherwise, so that one point in thousands has another fate.
  const double few = 1e-3 * static_cast<double>(expected.size());
  EXPECT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()), few);
  EXPECT_LT(pointsApart(found, expected), few);
  EXPECT_EQ(whole.model().tracked.points.size(), shortClip().seeds.size());

  Reconstructor first = reconstructorOf(partsWithModelOnTheDevice(5)),
                second = reconstructorOf(partsWithModelOnTheDevice(9));
  run(first, 0, 2);
  second.restore(parseCheckpoint(checkpointBytes({"same", 2, first.state()}), "a").state);
  run(second, 2, 4);
  EXPECT_TRUE(bytesOf(second.model().model) == bytesOf(found));
}

/// A device that is lost in its third frame, after the warp.
class FailingComparer : public FrameComparer {
 public:
  explicit FailingComparer(std::unique_ptr<FrameComparer> comparer)
      : comparer_(std::move(comparer)) {}
  std::vector<std::int32_t> visiblePoints(const PointModel& model, const Observation& observation,
                                          const Raster<PixelState>& states,
                                          const VisibilityOptions& options) override {
    return comparer_->visiblePoints(model, observation, states, options);
  }
  FrameComparison compare(const PointModel& model, const WarpGraph& graph,
                          const Observation& observation, const Raster<PixelState>& states,
                          const FusionOptions& options) override {
    if (++frames_ > 1) throw BackendError("CUDA: the device is lost");
    return comparer_->compare(model, graph, observation, states, options);
  }
  BackProjectionError error(const PointModel& model, const Observation& observation,
                            const Raster<PixelState>& states) override {
    return comparer_->error(model, observation, states);
  }

 private:
  std::unique_ptr<FrameComparer> comparer_;
  int frames_ = 0;
};

TEST(HostBackend, AfterALossTheModelIsThatOfTheFrameBefore) {
  BackendParts parts = partsWithModelOnTheDevice(1);
  const auto makeComparer = parts.makeComparer;
  parts.makeComparer = [=](const RectifiedRig& rig) {
    return std::make_unique<FailingComparer>(makeComparer(rig));
  };
  Reconstructor losing = reconstructorOf(parts),
                whole = reconstructorOf(partsWithModelOnTheDevice(1));
  run(losing, 0, 2);
  EXPECT_THROW(losing.process(shortClip().frames[2]), BackendError);
  run(whole, 0, 2);
  EXPECT_TRUE(bytesOf(losing.model().model) == bytesOf(whole.model().model));
  const MaterialPoints &left = losing.model().tracked, &expected = whole.model().tracked;
  for (std::size_t i = 0; i < expected.points.size(); ++i)
    EXPECT_EQ(left.points[i].position_mm, expected.points[i].position_mm);
}

}  // namespace
}  // namespace softscope::test
