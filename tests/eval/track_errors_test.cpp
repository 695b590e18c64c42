// tests/eval/track_errors_test.cpp: three points, by hand.
#include "eval/motion/track_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope {
namespace {

constexpr double kTrackRounding = 1e-12;

Eigen::Isometry3d shift(double x_mm) { return Eigen::Isometry3d(Eigen::Translation3d(x_mm, 0, 0)); }

TEST(TrackErrors, MovesEstimatesIntoTheTrueWorldAndSetsTheControlBesideThem) {
  const TrueTracks truth{
      {{0, 0}, {0, 0, 0}}, {{0, 1}, {9, 0, 0}}, {{1, 0}, {0, 3, 0}}, {{1, 1}, {9, 0, 4}}};
  const std::vector<TrackSample> estimate{{0, 0, {0, 0, 0}, true},
                                          {0, 1, {9, 0, 0}, true},
                                          {1, 0, {-2, 3, 1}, true},   // shifted by 2: 1 mm off
                                          {1, 1, {7, 0, 2}, false}};  // 2 mm off
  const TrackErrors errors = trackErrors(truth, estimate, {{0, shift(0)}, {1, shift(2)}}, {{1, 0}});
  ASSERT_EQ(errors.each.size(), 4u);
  EXPECT_NEAR(errors.predicted_mm.mean, 1, kTrackRounding) << "what truth calls unseen";
  EXPECT_NEAR(errors.observed_mm.mean, 2.0 / 3, kTrackRounding);
  EXPECT_NEAR(errors.each[2].errorMm(), 1, kTrackRounding);
  EXPECT_NEAR(errors.each[2].control_mm, 3, kTrackRounding);
  EXPECT_NEAR(errors.error_mm.mean, 0.75, kTrackRounding);
  EXPECT_NEAR(errors.control_mm.mean, 1.75, kTrackRounding);
  EXPECT_NEAR(errors.last_frame_mm.mean, 1.5, kTrackRounding);
  EXPECT_NEAR(errors.visible_mm.mean, 1.0 / 3, kTrackRounding);
  EXPECT_NEAR(errors.hidden_mm.mean, 2, kTrackRounding);
  EXPECT_NEAR(errors.reported_share, 1, kTrackRounding);
}

TEST(TrackErrors, HoldsErrorsAgainstTheirPrediction) {
  const TrueTracks truth{{{0, 0}, {0, 0, 0}}, {{0, 1}, {0, 0, 0}}, {{0, 2}, {0, 0, 0}}};
  const std::vector<TrackSample> estimate{{0, 0, {0, 0, 1}, true, 0.5},  // exactly twice
                                          {0, 1, {0, 3, 4}, true, 2.0},  // 2.5 times
                                          {0, 2, {0, 0, 1}, true}};      // nothing predicted
  const TrackErrors errors = trackErrors(truth, estimate, {{0, shift(0)}});
  EXPECT_EQ(errors.sigma.count, 2u);
  EXPECT_NEAR(errors.sigma.error_over_sigma, std::sqrt((4 + 6.25) / 2), kTrackRounding);
  EXPECT_NEAR(errors.sigma.within_2_sigma_share, 0.5, kTrackRounding);
}

TEST(TrackErrors, CountsWhatItCannotJudge) {
  const TrueTracks truth{{{5, 0}, {0, 0, 0}}, {{6, 0}, {0, 0, 0}}};
  const std::vector<TrackSample> estimate{{5, 0, {0, 0, 1}, true},
                                          {5, 7, {0, 0, 0}, true},               // no such point
                                          {4, 0, {0, 0, 0}, true},               // before the run
                                          {7, 0, {0, 0, 0}, true},               // after it
                                          {6, 0, {0, 0, std::nan("")}, false}};  // lost
  const TrackErrors errors = trackErrors(truth, estimate, {{5, shift(0)}, {6, shift(0)}});
  EXPECT_EQ(errors.each.size(), 1u);
  EXPECT_EQ(errors.without_truth, 3u);
  EXPECT_EQ(errors.lost, 1u);
  EXPECT_NEAR(errors.reported_share, 0.5, kTrackRounding);
  EXPECT_EQ(errors.last_frame_mm.count, 0u) << "the last frame is 6, where the point was lost";
}

TEST(TrackErrors, WithoutTruthThereAreNoNumbers) {
  const TrackErrors errors = trackErrors({}, {{0, 0, {0, 0, 0}, true}}, {{0, shift(0)}});
  EXPECT_TRUE(std::isnan(errors.error_mm.mean));
  EXPECT_TRUE(std::isnan(errors.reported_share));
}

}  // namespace
}  // namespace softscope
