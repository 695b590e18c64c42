// tests/cuda/survey_passes_test.cpp: frames surveyed ahead give the CPU's numbers and states; they
// are those at hand, and no others are.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/frame/survey_run.h"
#include "host_machine.h"
#include "survey_cases.h"

namespace softscope::test {
namespace {

using HostSurvey = cuda::SurveyRun<HostMachine>;

class Surveys : public testing::Test {
 protected:
  void survey(const ComparisonScene& scene) {
    surveyFrame(scene.observation(), scene.options().pixels, &survey_, gray_);
  }
  void expectAtHand(const ComparisonScene& scene) const {
    const Observation frame = scene.observation();
    const DepthMap& depth = frame.depth;
    ASSERT_TRUE(frames_->at_hand.holds(depth.depth_mm.values.data()));
    const std::size_t pixels = depth.depth_mm.size();
    EXPECT_EQ(std::memcmp(frames_->at_hand.depth_mm, depth.depth_mm.values.data(), 4 * pixels), 0);
    EXPECT_EQ(std::memcmp(frames_->at_hand.normals, frame.normals.values.data(), 12 * pixels), 0);
    EXPECT_EQ(std::memcmp(frames_->at_hand.states, scene.states().values.data(), pixels), 0);
    EXPECT_EQ(std::memcmp(frames_->at_hand.match_gray, gray_.values.data(), pixels), 0);
    EXPECT_EQ(std::memcmp(frames_->at_hand.colour, frame.colour.values.data(), 3 * pixels), 0);
    EXPECT_EQ(frames_->at_hand.sigma_mm == nullptr, depth.sigma_mm.empty());
    EXPECT_EQ(frames_->at_hand.ignore, nullptr);
  }

  const ComparisonScene first_{comparisonCases()[0]}, second_{comparisonCases()[1]};
  const GrayImage gray_{241, 178, 77};
  std::shared_ptr<cuda::SharedFrames> frames_ = std::make_shared<cuda::SharedFrames>();
  HostSurvey survey_{ComparisonScene::camera(), frames_, 1U};
};

TEST_F(Surveys, GiveTheCpusNumbersAndStatesInAnyOrderOfThreads) {
  for (const unsigned seed : {1U, 2U}) {
    HostSurvey survey(ComparisonScene::camera(), std::make_shared<cuda::SharedFrames>(), seed);
    expectTheCpusSurvey(&survey);
  }
}

TEST_F(Surveys, LieBesideTheFrameAtHandUntilTheyAreUsed) {
  survey(first_);
  survey_.use(first_.observation().depth);
  expectAtHand(first_);
  survey(second_);
  expectAtHand(first_);
  survey_.use(second_.observation().depth);
  expectAtHand(second_);
}

TEST_F(Surveys, HaveARelief) {
  const DepthMap& depth = first_.observation().depth;
  survey(first_);
  EXPECT_TRUE(survey_.reliefOf(depth, kFocalBaseline).empty()) << "it is not in use yet";
  survey_.use(depth);
  survey(second_);
  expectTheCpusRelief(depth, ComparisonScene::camera(), &survey_);
}

TEST_F(Surveys, WaitForTheirTurn) {
  const ComparisonScene third(comparisonCases()[2]);
  const auto waits = [&](const ComparisonScene& scene) {
    const float* depth_mm = scene.observation().depth.depth_mm.values.data();
    return frames_->find(depth_mm).holds(depth_mm);
  };
  survey(first_);
  survey_.use(first_.observation().depth);
  survey(second_);
  survey(third);
  expectAtHand(first_);
  EXPECT_TRUE(waits(second_) && waits(third));
  survey_.use(second_.observation().depth);
  expectAtHand(second_);
  survey(first_);
  EXPECT_TRUE(waits(third) && waits(first_));
  survey_.use(first_.observation().depth);
  expectAtHand(first_);
  EXPECT_FALSE(waits(third)) << "its turn is over";
}

TEST_F(Surveys, OfTooManyTheLastWait) {
  const ComparisonScene third(comparisonCases()[2]);
  for (const ComparisonScene* scene : {&first_, &second_, &third}) survey(*scene);
  survey_.use(third.observation().depth);
  expectAtHand(third);
  for (const ComparisonScene* scene : {&first_, &second_, &first_}) survey(*scene);
  expectAtHand(third);
}

TEST_F(Surveys, AreUsedOnceAndForTheirFrameAlone) {
  survey(first_);
  survey_.use(second_.observation().depth);
  EXPECT_FALSE(frames_->at_hand.holds(first_.observation().depth.depth_mm.values.data()));
  EXPECT_FALSE(frames_->at_hand.holds(second_.observation().depth.depth_mm.values.data()));
  survey_.use(first_.observation().depth);
  EXPECT_FALSE(frames_->at_hand.holds(first_.observation().depth.depth_mm.values.data()));
}

/// Only where it is known to lie there; here it differs, so that one sees from where it came.
TEST_F(Surveys, TakeDepthFromTheDevice) {
  const Observation frame = first_.observation();
  DepthMap other = frame.depth;
  for (float& depth_mm : other.depth_mm.values) depth_mm += 7;
  const auto medianMm = [&](const float* host_depth_mm) {
    frames_->measured = {host_depth_mm, other.depth_mm.values.data(), other.sigma_mm.values.data(),
                         frame.normals.values.data()};
    return surveyFrame(frame, first_.options().pixels, &survey_).depths.median_mm;
  };
  const double from_host_mm = medianMm(nullptr);
  EXPECT_NEAR(medianMm(frame.depth.depth_mm.values.data()), from_host_mm + 7, 1e-4);
  EXPECT_EQ(frames_->measured.depth_mm, nullptr);  // it is taken once
}

TEST_F(Surveys, OfAnotherCameraAreRefused) {
  PinholeCamera small = ComparisonScene::camera();
  --small.width_px;
  HostSurvey survey(small, frames_, 1U);
  EXPECT_THROW(surveyFrame(first_.observation(), first_.options().pixels, &survey), Error);
}

}  // namespace
}  // namespace softscope::test
