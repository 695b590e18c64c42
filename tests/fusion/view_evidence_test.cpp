// tests/fusion/view_evidence_test.cpp: a right pose is confirmed, a wrong one is not.
#include "fusion/view_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/made_shots.h"

namespace softscope {
namespace {

const auto kTexturedPlane = test::plane(55, 0.2, 0.1);

/// A textured shot of 320 x 240 pixels, seen from that pose.
test::Shot texturedShot(const Eigen::Isometry3d& pose, double noise_gray = 2) {
  test::Shot shot = test::takeShot(kTexturedPlane, test::smallCamera(320, 240, 280), pose);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, noise_gray);
  for (int v = 0; v < shot.left.height_px; ++v)
    for (int u = 0; u < shot.left.width_px; ++u) {
      const Eigen::Vector3d place =
          pose * liftPixel<double>(shot.left, u, v, shot.truth_mm.at(u, v));
      const double gray = 100 + 90 * (test::solidTexture(place, 1.1) - 0.5) +
                          50 * (test::solidTexture(place, 0.4) - 0.5) + noise(random);
      const auto byte = static_cast<std::uint8_t>(std::clamp(std::lround(gray), 0L, 255L));
      shot.colour.at(u, v) = {byte, byte, byte};
    }
  return shot;
}

PointModel modelOf(const test::Shot& shot) {
  PointModel model;
  InsertionMemory memory;
  test::update(shot, {}, &memory, &model);
  return model;
}

/// Of the model, compared with the shot as if the camera pose were `claimed`.
ViewEvidence evidenceAt(const PointModel& model, test::Shot shot,
                        const Eigen::Isometry3d& claimed) {
  shot.world_from_left = claimed;
  const Observation observation = shot.observation();
  const DrawnPoints drawn(model, posedCamera(shot.left, claimed));
  return viewEvidence(drawn, observation, classifyPixels(observation, {}), {});
}

TEST(ViewEvidence, ConfirmsTheRightPose) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  const Eigen::Isometry3d pose = test::shifted(2, -1, 1.5);
  const ViewEvidence evidence = evidenceAt(model, texturedShot(pose), pose);
  EXPECT_GT(evidence.blocks, 50);
  EXPECT_GT(evidence.depth_share, 0.99);
  EXPECT_GT(evidence.image_share, 0.95);
  EXPECT_GT(evidence.agreement(), 0.9);
}

// On a plane depth hardly changes with a shift or a rotation: the image decides.
TEST(ViewEvidence, RefusesAPoseThatIsThreeMillimetresOff) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  const test::Shot shot = texturedShot(test::shifted(2, -1, 1.5));
  EXPECT_LT(evidenceAt(model, shot, test::shifted(5, -1, 1.5)).agreement(), 0.1);
  Eigen::Isometry3d turned = test::shifted(2, -1, 1.5);
  turned.rotate(Eigen::AngleAxisd(0.19, Eigen::Vector3d::UnitZ()));  // 11 degrees
  EXPECT_LT(evidenceAt(model, shot, turned).agreement(), 0.2);       // its centre stays where it is
}

// From 17 mm, points of a model seen from 55 mm are 3.3 px apart: too few for blocks of 16 px.
TEST(ViewEvidence, ComparesASparseModelInLargerBlocks) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  const Eigen::Isometry3d near = test::shifted(0, 0, 38);
  const test::Shot shot = texturedShot(near);
  const ViewEvidence evidence = evidenceAt(model, shot, near);
  EXPECT_GT(evidence.blocks, 30);
  EXPECT_GT(evidence.agreement(), 0.9);
  EXPECT_LT(evidenceAt(model, shot, test::shifted(1, 0, 38)).agreement(), 0.2);
}

TEST(ViewEvidence, RefusesAWrongDistance) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  const test::Shot shot = texturedShot(test::shifted(0, 0, 0));
  const ViewEvidence evidence = evidenceAt(model, shot, test::shifted(0, 0, 3));
  EXPECT_LT(evidence.depth_share, 0.05);
  EXPECT_LT(evidence.agreement(), 0.05);
}

TEST(ViewEvidence, IsNoEvidenceWithoutTexture) {
  const test::Shot flat = test::takeShot(kTexturedPlane, test::smallCamera(320, 240, 280));
  const ViewEvidence evidence = evidenceAt(modelOf(flat), flat, flat.world_from_left);
  EXPECT_EQ(evidence.blocks, 0);
  EXPECT_TRUE(std::isnan(evidence.image_share));
  EXPECT_EQ(evidence.agreement(), 0);
  EXPECT_GT(evidence.depth_share, 0.99);
}

// Brightness that only noise makes must not pass for agreement.
TEST(ViewEvidence, NoiseAgreesByChanceOnly) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  test::Shot noise = test::takeShot(kTexturedPlane, test::smallCamera(320, 240, 280));
  std::mt19937 random(9);
  for (Rgb8& colour : noise.colour.values) {
    const auto byte = static_cast<std::uint8_t>(100 + random() % 50);
    colour = {byte, byte, byte};
  }
  EXPECT_LT(evidenceAt(model, noise, noise.world_from_left).agreement(), 0.1);
}

TEST(ViewEvidence, IsTheSameOnOneThread) {
  const PointModel model = modelOf(texturedShot(test::shifted(0, 0, 0)));
  const Eigen::Isometry3d pose = test::shifted(1, 0, 0);
  const ViewEvidence many = evidenceAt(model, texturedShot(pose), pose);
  const ThreadLimit one(1);
  const ViewEvidence alone = evidenceAt(model, texturedShot(pose), pose);
  EXPECT_EQ(many.depth_share, alone.depth_share);
  EXPECT_EQ(many.image_share, alone.image_share);
}

TEST(ViewEvidence, NeedsThePixelStatesOfItsObservation) {
  const test::Shot shot = texturedShot(test::shifted(0, 0, 0));
  const PointModel nothing;
  const DrawnPoints drawn(nothing, posedCamera(shot.left, shot.world_from_left));
  EXPECT_THROW(viewEvidence(drawn, shot.observation(), Raster<PixelState>(3, 3), {}), OptionError);
}

}  // namespace
}  // namespace softscope
