// tests/pipeline/backends_test.cpp: every back end gives one model, alone, looking ahead, and by
// turns.
#include "pipeline/backends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "pipeline/checkpoint.h"
#include "pipeline/cpu_backend.h"
#include "short_clip.h"

namespace softscope::test {
namespace {

Reconstructor reconstructorOn(const std::string& backend) {
  const ReconstructionOptions options = smallOptions();
  return {makeBackend(backend, shortClip().calibration, options).part, options};
}

Reconstructor reconstructorOf(const BackendParts& parts) {
  const ReconstructionOptions options = smallOptions();
  return {makeCpuBackend(shortClip().calibration, options, parts), options};
}

/// Frames begin … end - 1, each with those after it.
std::vector<FrameRecord> run(Reconstructor& reconstructor, std::size_t begin, std::size_t end) {
  const std::vector<Frame>& frames = shortClip().frames;
  std::vector<FrameRecord> records;
  for (std::size_t i = begin; i < end; ++i)
    records.push_back(reconstructor.process(frames[i], framesAfter(frames, i)));
  return records;
}

std::string modelOf(const Reconstructor& reconstructor) {
  return bytesOf(reconstructor.model().model);
}

const PointModel& pointsOfTheCpu() {
  static const PointModel model = [] {
    Reconstructor reconstructor = reconstructorOn("cpu");
    run(reconstructor, 0, 4);
    return reconstructor.model().model;
  }();
  return model;
}

const std::string& modelOfTheCpu() {
  static const std::string bytes = bytesOf(pointsOfTheCpu());
  return bytes;
}

void expectModelOfTheCpu(const Reconstructor& reconstructor, const std::string& backend) {
  expectModel(pointsOfTheCpu(), backend, reconstructor.model().model);
}

class EveryBackend : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() != "cuda") return;
    if (const std::string why = cudaUnavailableReason(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_P(EveryBackend, GivesTheModelOfTheCpu) {
  Reconstructor reconstructor = reconstructorOn(GetParam());
  EXPECT_EQ(reconstructor.backend().name(), GetParam());
  reconstructor.track(shortClip().seeds);
  const std::vector<FrameRecord> records = run(reconstructor, 0, 4);
  EXPECT_EQ(records.back().status, FrameStatus::kFused) << records.back().reason;
  EXPECT_EQ(records.back().tracked.size(), shortClip().seeds.size());
  EXPECT_FALSE(records.back().times.empty());
  expectModelOfTheCpu(reconstructor, GetParam());
}

/// Tracked points must not take the numbers that model points had before thinning.
TEST_P(EveryBackend, TracksHoldTheModelPointBesideThemWhereTheFirstModelIsThinned) {
  ReconstructionOptions options = smallOptions();
  options.fusion.insertion.spacing_mm = 1;  // cells of which many hold two new points
  Reconstructor reconstructor{makeBackend(GetParam(), shortClip().calibration, options).part,
                              options};
  reconstructor.track(shortClip().seeds);
  run(reconstructor, 0, 2);
  const ModelState& state = reconstructor.model();
  for (const MaterialPoints::Point& point : state.tracked.points) {
    ASSERT_GE(point.model_point, 0);
    const Eigen::Vector3f beside_mm =
        state.model.positions_mm[static_cast<std::size_t>(point.model_point)];
    EXPECT_LT((beside_mm.cast<double>() - point.position_mm).norm(), 2) << "point " << point.id;
  }
}

TEST_P(EveryBackend, GivesTheSameBytesAgainAndAcrossItsOwnCheckpoint) {
  Reconstructor whole = reconstructorOn(GetParam()), first = reconstructorOn(GetParam()),
                second = reconstructorOn(GetParam());
  run(whole, 0, 4);
  run(first, 0, 2);
  second.restore(parseCheckpoint(checkpointBytes({"same", 2, first.state()}), "a").state);
  run(second, 2, 4);
  EXPECT_TRUE(modelOf(second) == modelOf(whole));
}

TEST_P(EveryBackend, GoesOnFromACheckpointOfTheCpuAndBack) {
  Reconstructor first = reconstructorOn("cpu");
  run(first, 0, 1);
  Reconstructor second = reconstructorOn(GetParam());
  second.restore(parseCheckpoint(checkpointBytes({"same", 1, first.state()}), "a").state);
  run(second, 1, 3);
  Reconstructor third = reconstructorOn("cpu");
  third.restore(parseCheckpoint(checkpointBytes({"same", 3, second.state()}), "b").state);
  run(third, 3, 4);
  expectModelOfTheCpu(third, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Built, EveryBackend, testing::ValuesIn(builtBackends()),
                         [](const auto& each) { return each.param; });

class WorkingAhead : public testing::TestWithParam<FramesAhead> {
 protected:
  WorkingAhead() {
    parts.ahead_from_threads = 1;
    parts.ahead = GetParam();
  }
  BackendParts parts;
};

TEST_P(WorkingAhead, GivesTheSameModelInWhateverOrderFramesCome) {
  Reconstructor ahead = reconstructorOf(parts);
  run(ahead, 0, 4);
  EXPECT_TRUE(modelOf(ahead) == modelOfTheCpu());

  const std::vector<Frame>& frames = shortClip().frames;
  Reconstructor mistaken = reconstructorOf(parts);
  for (std::size_t i = 0; i < 4; ++i)
    mistaken.process(frames[i], {sharing(frames[5 - i]), sharing(frames[(i + 2) % 5]),
                                 sharing(frames[i]), sharing(frames[(i + 1) % 5])});
  EXPECT_TRUE(modelOf(mistaken) == modelOfTheCpu());
}

// A caller may stop after any frame, and continue with other images.
TEST_P(WorkingAhead, KeepsTheFramesThatItReads) {
  Reconstructor reconstructor = reconstructorOf(parts);
  const std::vector<Frame>& frames = shortClip().frames;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto image = std::make_shared<const Frame>(frames[i]);  // freed after this frame
    reconstructor.process(*image, {std::make_shared<const Frame>(frames[5 - i]),
                                   std::make_shared<const Frame>(frames[(i + 2) % 5]),
                                   std::make_shared<const Frame>(frames[i])});
  }
  EXPECT_TRUE(modelOf(reconstructor) == modelOfTheCpu());
}

TEST_P(WorkingAhead, LeavesTrackedPointsWhereTheyAreWithout) {
  const auto tracksOf = [&](int ahead_from_threads) {
    parts.ahead_from_threads = ahead_from_threads;
    Reconstructor reconstructor = reconstructorOf(parts);
    reconstructor.track(shortClip().seeds);
    std::vector<double> values;
    for (const FrameRecord& record : run(reconstructor, 0, 4))
      for (const TrackedPosition& point : record.tracked) {
        values.push_back(point.visible);
        if (!point.position_mm.allFinite()) continue;  // not measured yet
        values.insert(values.end(), point.position_mm.begin(), point.position_mm.end());
        if (point.visible) values.push_back(point.sigma_mm);
      }
    return values;
  };
  const std::vector<double> ahead = tracksOf(1), in_turn = tracksOf(1000);
  EXPECT_GT(ahead.size(), 4 * shortClip().seeds.size());
  EXPECT_EQ(ahead, in_turn);
}

TEST_P(WorkingAhead, WhatIsWrongWithAFrameIsToldWhenItsTurnComes) {
  Reconstructor reconstructor = reconstructorOf(parts);
  const std::vector<Frame>& frames = shortClip().frames;
  Frame one_eyed = frames[1];
  one_eyed.pair.right = {};
  EXPECT_TRUE(reconstructor.process(frames[0], {sharing(one_eyed), sharing(frames[2])}).fused());
  const FrameRecord bad = reconstructor.process(one_eyed, {sharing(frames[2])});
  EXPECT_EQ(bad.status, FrameStatus::kUnreadable);
  EXPECT_THAT(bad.reason, testing::HasSubstr("no right view"));
  EXPECT_TRUE(reconstructor.process(frames[2]).fused());
}

INSTANTIATE_TEST_SUITE_P(ByFrames, WorkingAhead,
                         testing::Values(FramesAhead{0, 1}, FramesAhead{1, 2}, FramesAhead{2, 4}),
                         [](const auto& one) {
                           return std::to_string(one.param.measured) + "Of" +
                                  std::to_string(one.param.aligned);
                         });

/// A device that is lost at its third frame.
class FailingStage : public StereoStage {
 public:
  explicit FailingStage(std::unique_ptr<StereoStage> stage) : stage_(std::move(stage)) {}
  std::string name() const override { return stage_->name(); }
  StereoSurface measure(const AlignedPair& aligned, const MatchableViews& prepared,
                        const Mask& mask) override {
    if (++frames_ > 2) throw BackendError("CUDA: the device is lost");
    return stage_->measure(aligned, prepared, mask);
  }

 private:
  std::unique_ptr<StereoStage> stage_;
  int frames_ = 0;
};

TEST(LostDevice, LeavesAModelWithWhichTheCpuGoesOn) {
  BackendParts parts;
  parts.name = "cuda";
  parts.ahead_from_threads = 1;
  parts.makeStereo = [](const StereoOptions& options, const RectifiedRig& rig) {
    return std::make_unique<FailingStage>(makeCpuStereoStage(options, rig));
  };
  Reconstructor on_device = reconstructorOf(parts);
  run(on_device, 0, 2);
  EXPECT_THROW(run(on_device, 2, 3), BackendError);
  Reconstructor on_cpu = reconstructorOn("cpu");
  on_cpu.restore(parseCheckpoint(checkpointBytes({"same", 2, on_device.state()}), "a").state);
  run(on_cpu, 2, 4);
  EXPECT_TRUE(modelOf(on_cpu) == modelOfTheCpu());
}

TEST(MakeBackend, AutoSaysWhatItTookAndWhy) {
  const bool has_gpu = cudaUnavailableReason().empty();
  ReconstructionOptions options = smallOptions();
  const auto chosen = makeBackend("auto", shortClip().calibration, options);
  EXPECT_EQ(chosen.name, has_gpu ? "cuda" : "cpu");
  EXPECT_EQ(chosen.part->name(), chosen.name);
  EXPECT_EQ(chosen.why.find('\n'), std::string::npos);
  EXPECT_FALSE(chosen.why.empty());

  options.depth.stereo.method = "sgbm";
  const auto without_kernels = makeBackend("auto", shortClip().calibration, options);
  EXPECT_EQ(without_kernels.name, "cpu");
  EXPECT_EQ(without_kernels.why, "sgbm has no GPU version");

  const auto depth = makeFrameDepth("auto", shortClip().calibration, smallOptions().depth);
  EXPECT_EQ(depth.name, has_gpu ? "cuda" : "cpu");
}

TEST(MakeBackend, CudaIsNotReplacedInSilence) {
  const StereoCalibration& calibration = shortClip().calibration;
  EXPECT_THROW(makeBackend("gpu", calibration, smallOptions()), OptionError);
  const std::string why = cudaUnavailableReason();
  if (why.empty()) {
    ReconstructionOptions options = smallOptions();
    options.depth.stereo.method = "sgbm";
    EXPECT_THROW(makeBackend("cuda", calibration, options), OptionError);
    return;
  }
  for (const bool whole : {true, false}) try {
      if (whole)
        makeBackend("cuda", calibration, smallOptions());
      else
        makeFrameDepth("cuda", calibration, smallOptions().depth);
      ADD_FAILURE() << "no GPU, and no error";
    } catch (const BackendError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
      EXPECT_THAT(error.what(), testing::HasSubstr("`backend=` cpu"));
    }
}

}  // namespace
}  // namespace softscope::test
