// tests/fusion/anchor_agreement_test.cpp: anchors stay where the texture slips, and follow tissue
// of another appearance.
#include "fusion/anchor_agreement.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

/// A texture of high contrast on a plane, 0.1 mm per pixel, moved along the rows.
Shot texturedShot(double slip_px, double gain = 1, double other_mm = 0) {
  Shot shot = takeShot(plane(55), smallCamera(192, 144));
  for (int v = 0; v < shot.left.height_px; ++v)
    for (int u = 0; u < shot.left.width_px; ++u) {
      const Eigen::Vector3d place(0.1 * (u - slip_px), 0.1 * v, other_mm);
      const double gray =
          gain * std::clamp(110 + 600 * (solidTexture(place, 0.5) - 0.5), 30.0, 190.0);
      const auto byte = static_cast<std::uint8_t>(std::lround(gray));
      shot.colour.at(u, v) = {byte, byte, byte};
    }
  return shot;
}

FusionOptions withoutGain() {
  FusionOptions options;
  options.colour.compensate_gain = false;
  return options;
}

PointModel modelOf(const Shot& shot) {
  PointModel model;
  InsertionMemory memory;
  update(shot, withoutGain(), &memory, &model);
  return model;
}

/// Share of the model's seen points whose anchors agree with the shot.
double agreeing(const PointModel& model, const Shot& shot, int fewest_seen = 4000) {
  const Observation observation = shot.observation();
  const Visibility visibility =
      findVisible(model, observation, classifyPixels(observation, {}), VisibilityOptions());
  const AnchorAgreement anchored(model, observation, visibility);
  int seen = 0, agree = 0;
  for (const PointSight& point : visibility.points) {
    if (point.sight != Sight::kSeen) continue;
    ++seen;
    agree += anchored.at(point.pixel);
  }
  EXPECT_GT(seen, fewest_seen);
  return static_cast<double>(agree) / seen;
}

TEST(AnchorAgreement, IsBlindToASlipAndToExposure) {
  const PointModel model = modelOf(texturedShot(0));
  EXPECT_GT(agreeing(model, texturedShot(0)), 0.98);  // corners have few points
  EXPECT_GT(agreeing(model, texturedShot(1)), 0.95);
  EXPECT_GT(agreeing(model, texturedShot(0, 0.6)), 0.98);
}

/// Each second point: fewer than 30 in a block of 16 x 16 pixels.
PointModel thinned(const PointModel& model) {
  PointModel few;
  for (std::size_t i = 0; i < model.size(); i += 2)
    few.add(model.positions_mm[i], model.normals[i], model.colours[i], model.weights[i]);
  return few;
}

TEST(AnchorAgreement, ComparesASparseModelInLargerBlocks) {
  const PointModel model = thinned(modelOf(texturedShot(0)));
  constexpr int kFewestSeen = 2000;
  EXPECT_GT(agreeing(model, texturedShot(0), kFewestSeen), 0.98);
  EXPECT_GT(agreeing(model, texturedShot(1), kFewestSeen), 0.95);
  EXPECT_LT(agreeing(model, texturedShot(0, 1, 50), kFewestSeen), 0.02);
}

TEST(AnchorAgreement, EndsWhereTheTissueLooksDifferent) {
  const PointModel model = modelOf(texturedShot(0));
  EXPECT_LT(agreeing(model, texturedShot(0, 1, 50)), 0.02);
  EXPECT_EQ(agreeing(model, takeShot(plane(55), smallCamera(192, 144))), 0);  // one colour
  EXPECT_FALSE(AnchorAgreement().at(0));
}

TEST(AnchorAgreement, IsTheSameOnAnyNumberOfThreads) {
  const PointModel model = modelOf(texturedShot(0));
  std::vector<double> shares;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    shares.push_back(agreeing(model, texturedShot(2.5)));
  }
  EXPECT_GT(shares[0], 0);
  EXPECT_LT(shares[0], 1);
  EXPECT_EQ(shares[1], shares[0]);
  EXPECT_EQ(shares[2], shares[0]);
}

// A slip of 1 px changes the brightness of most points by more than the step that an average in 8
// bits takes; if the anchors followed it, no match could ever undo it.
TEST(AnchorAgreement, KeepsAnchorsThroughALastingSlip) {
  for (const bool hold : {true, false}) {
    FusionOptions options = withoutGain();
    options.colour.hold_anchors = hold;
    InsertionMemory memory;
    PointModel model;
    update(texturedShot(0), options, &memory, &model);
    const PointModel before = model;
    for (int k = 0; k < 60; ++k) update(texturedShot(1), options, &memory, &model);
    ASSERT_GE(model.size(), before.size());
    int moved = 0, repainted = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved += model.anchors[i] != before.anchors[i];
      repainted += std::abs(model.colours[i].red - before.colours[i].red) > 20;
    }
    EXPECT_GT(repainted, static_cast<int>(before.size() / 10));
    if (hold)
      EXPECT_LT(moved, static_cast<int>(before.size() / 20));
    else
      EXPECT_GT(moved, static_cast<int>(before.size() / 10));
  }
}

TEST(AnchorAgreement, LetsAnchorsFollowAnotherTexture) {
  InsertionMemory memory;
  PointModel model;
  update(texturedShot(0), withoutGain(), &memory, &model);
  const Shot other = texturedShot(0, 1, 50);
  for (int k = 0; k < 120; ++k) update(other, withoutGain(), &memory, &model);
  double before = 0, now = 0;
  const PointModel first = modelOf(texturedShot(0));
  for (std::size_t i = 0; i < first.size(); ++i) {
    before += std::abs(first.anchors[i] - toGray(model.colours[i]));
    now += std::abs(model.anchors[i] - toGray(model.colours[i]));
  }
  EXPECT_LT(now, before / 2);
}

}  // namespace
}  // namespace softscope::test
