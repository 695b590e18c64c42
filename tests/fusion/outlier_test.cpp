// tests/fusion/outlier_test.cpp: silhouettes, wrong depths and tissue that has gone.
#include <gtest/gtest.h>

#include "fusion/back_projection_error.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

/// A ball of 4 mm in front of a wall; the wall starts 8 mm behind its middle.
Surface ballBeforeWall() { return nearest(sphere({0, 0, 50}, 3), plane(58)); }

/// Distance to the nearer of the two surfaces, mm.
double offSurface(const Eigen::Vector3f& p) {
  const double ball = std::abs((p.cast<double>() - Eigen::Vector3d(0, 0, 50)).norm() - 3);
  return std::min(ball, std::abs(p.z() - 58.0));
}

/// Silhouettes in stereo: pixels next to a step have any depth between the two surfaces.
void smearEdges(Shot* shot) {
  const Raster<float> truth = shot->truth_mm;
  for (int v = 1; v + 1 < truth.height_px; ++v)
    for (int u = 1; u + 1 < truth.width_px; ++u) {
      const float next = truth.at(u + 1, v), below = truth.at(u, v + 1);
      const float other = std::abs(next - truth.at(u, v)) > 2 ? next : below;
      if (std::abs(other - truth.at(u, v)) > 2)
        shot->depth.depth_mm.at(u, v) = 0.5f * (other + truth.at(u, v));
    }
}

TEST(Silhouettes, LeaveNoHalo) {
  PointModel model;
  InsertionMemory memory;
  Shot shot;
  for (unsigned k = 0; k < 15; ++k) {
    shot = takeShot(ballBeforeWall(), smallCamera(128, 96), shifted(0.2 * k, 0.1 * k, 0));
    addNoise(k, &shot);
    smearEdges(&shot);
    update(shot, {}, &memory, &model);
    // One frame's noise is 0.1 mm along the ray: 5 sigma. A smeared pixel is 2 mm or more off.
    for (const Eigen::Vector3f& p : model.positions_mm) ASSERT_LT(offSurface(p), 0.5);
  }
  int on_ball = 0;
  for (const Eigen::Vector3f& p : model.positions_mm) on_ball += p.z() < 54;
  EXPECT_GT(on_ball, 400);  // and both surfaces are there
  EXPECT_GT(static_cast<int>(model.size()) - on_ball, 1000);
}

/// After `frames` with a tenth of the picture wrong each time, elsewhere each time.
PointModel modelOfWrongFrames(int first_wrong, int frames, const Surface& surface) {
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < frames; ++k) {
    Shot shot = takeShot(surface, smallCamera(128, 96));
    addNoise(static_cast<unsigned>(k), &shot);
    if (k >= first_wrong) addWrongPatches(0.10, 12, static_cast<unsigned>(k) + 100, &shot);
    update(shot, {}, &memory, &model);
  }
  return model;
}

double shareOff(const PointModel& model, double distance_mm, double limit_mm) {
  int off = 0;
  for (const Eigen::Vector3f& p : model.positions_mm)
    off += std::abs(p.z() - distance_mm) > limit_mm;
  return static_cast<double>(off) / static_cast<double>(model.size());
}

// Two patches of two frames may agree by chance (a tenth of a tenth of the picture, at the same
// depth within 2 of 11 mm): below 0.2 % of the points; they must not stay longer than that.
TEST(WrongDepths, DoNotEnterAGoodModel) {
  const PointModel model = modelOfWrongFrames(1, 30, plane(55));
  EXPECT_LT(shareOff(model, 55, 0.6), 0.002);
  double sum = 0;
  for (const Eigen::Vector3f& p : model.positions_mm) sum += p.z() - 55;
  EXPECT_NEAR(sum / static_cast<double>(model.size()), 0, 0.005);
}

// The first frame has nothing to be checked against: a tenth of the model is wrong, and must be
// gone when the next frames contradict it, in front of the surface and behind it.
TEST(WrongDepths, OfTheFirstFrameGoAgain) {
  EXPECT_GT(shareOff(modelOfWrongFrames(0, 1, plane(55)), 55, 0.6), 0.05);
  const PointModel model = modelOfWrongFrames(0, 15, plane(55));
  EXPECT_LT(shareOff(model, 55, 0.6), 0.002);
  EXPECT_GT(model.size(), 0.9 * modelOfWrongFrames(30, 15, plane(55)).size());  // no holes left
}

TEST(FreeSpace, RemovesTissueThatHasGone) {
  PointModel model;
  InsertionMemory memory;
  const Surface before = nearest(sphere({0, 0, 50}, 3), plane(58));
  for (unsigned k = 0; k < 12; ++k) {
    Shot shot = takeShot(before, smallCamera(128, 96));
    update(shot, {}, &memory, &model);
  }
  const auto onBall = [&] {
    int count = 0;
    for (const Eigen::Vector3f& p : model.positions_mm) count += p.z() < 54;
    return count;
  };
  const int all = onBall();
  ASSERT_GT(all, 400);
  const Shot after = takeShot(plane(58), smallCamera(128, 96));
  update(after, {}, &memory, &model);
  EXPECT_EQ(onBall(), all);  // one frame against ten is not yet sufficient
  // Five frames if the depth of the wall had the reference sigma; its error is 0.11 mm: six.
  for (int k = 0; k < 7; ++k) update(after, {}, &memory, &model);
  EXPECT_EQ(onBall(), 0);
  const Raster<PixelState> states = classifyPixels(after.observation(), {});
  for (int k = 0; k < 3; ++k) update(after, {}, &memory, &model);
  EXPECT_LT(backProjectionError(model, after.observation(), states).mean_mm, 1e-3);
}

TEST(FreeSpace, KeepsPointsThroughSingleWrongFrames) {
  PointModel model;
  InsertionMemory memory;
  const Shot right = takeShot(plane(55), smallCamera()), wrong = takeShot(plane(60), smallCamera());
  for (int k = 0; k < 40; ++k) update(k % 5 == 4 ? wrong : right, {}, &memory, &model);
  for (const Eigen::Vector3f& p : model.positions_mm) EXPECT_NEAR(p.z(), 55, 1e-3);
}

// Tissue that came nearer by more than the warp could follow: its old place must not stay behind.
TEST(HiddenPoints, AreRemovedJustBehindAMeasuredSurface) {
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < 12; ++k) update(takeShot(plane(55), smallCamera()), {}, &memory, &model);
  for (int k = 0; k < 8; ++k) update(takeShot(plane(51), smallCamera()), {}, &memory, &model);
  ASSERT_GT(model.size(), 1000);
  for (const Eigen::Vector3f& p : model.positions_mm) EXPECT_LT(p.z(), 52);
}

// A second organ far behind the first one is hidden, not gone.
TEST(HiddenPoints, StayFarBehindAMeasuredSurface) {
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < 12; ++k) update(takeShot(plane(60), smallCamera()), {}, &memory, &model);
  const std::size_t before = model.size();
  for (int k = 0; k < 8; ++k) update(takeShot(plane(45), smallCamera()), {}, &memory, &model);
  EXPECT_GT(model.size(), before + 1000);
}

TEST(Masks, KeepInstrumentsOut) {
  Shot shot = takeShot(ballBeforeWall(), smallCamera(128, 96));
  shot.mask = Mask(128, 96);
  for (std::size_t i = 0; i < shot.mask.size(); ++i)
    shot.mask.values[i] = shot.truth_mm.values[i] < 54;
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < 3; ++k) update(shot, {}, &memory, &model);
  ASSERT_FALSE(model.empty());
  for (const Eigen::Vector3f& p : model.positions_mm) EXPECT_GT(p.z(), 57.9);
}

}  // namespace
}  // namespace softscope::test
