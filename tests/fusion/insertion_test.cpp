// tests/fusion/insertion_test.cpp: where new points come from, and where they don't.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "fusion/back_projection_error.h"
#include "fusion/made_shots.h"
#include "fusion/point_insertion.h"

namespace softscope::test {
namespace {

TEST(Insertion, TakesTheFirstFrameAtTheRightDensity) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  InsertionMemory memory;
  const ModelUpdateSummary summary = update(shot, {}, &memory, &model);
  // 96 x 72 pixels of 0.0982 mm are 66.6 mm², 1666 cells of 0.2 mm and those cut by the border.
  EXPECT_NEAR(model.size(), 1666, 120);
  EXPECT_EQ(summary.insertion.inserted, static_cast<int>(model.size()));
  EXPECT_EQ(summary.insertion.unexplained_px, 96 * 72);
  for (std::size_t i = 0; i < model.size(); ++i) {
    EXPECT_NEAR(model.positions_mm[i].z(), 55, 1e-4);
    EXPECT_NEAR(model.normals[i].z(), -1, 1e-4);
    EXPECT_EQ(model.colours[i], (Rgb8{150, 90, 80}));
    EXPECT_NEAR(model.weights[i], 1, 0.01);  // sigma is the reference's
    EXPECT_FALSE(model.bindings[i].bound());
  }
}

// At 20 mm a pixel is 0.036 mm: points 0.2 mm apart leave gaps and blur the model view.
TEST(Insertion, NearTissueGetsAPointEvery2Point4Pixels) {
  const Shot shot = takeShot(plane(20), smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  const double in_image =
      96 * 72 / (InsertionOptions::kMostSpacingPx * InsertionOptions::kMostSpacingPx);
  EXPECT_NEAR(model.size(), in_image, 0.1 * in_image);
  const std::size_t before = model.size();
  update(shot, {}, &memory, &model);
  EXPECT_EQ(model.size(), before);
}

// A layer of noise is one layer: cells are as deep as the band, not as wide as they are.
TEST(Insertion, NoiseDoesNotDoubleTheLayer) {
  Shot shot = takeShot(plane(55), smallCamera());
  addNoise(1, &shot);
  PointModel model;
  InsertionMemory memory;
  FusionOptions options;
  options.density.cell_mm = 0.02;
  update(shot, options, &memory, &model);
  EXPECT_NEAR(model.size(), 1666, 350);
}

TEST(Insertion, DoesNotRepeatWhatIsThere) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  const std::size_t before = model.size();
  for (const double offset_mm : {-1.5, -0.5, 0.5, 1.5}) {  // within the band of 2 mm
    const ModelUpdateSummary summary =
        update(takeShot(plane(55 + offset_mm), smallCamera()), {}, &memory, &model);
    EXPECT_EQ(summary.insertion.inserted, 0) << offset_mm;
    EXPECT_EQ(summary.insertion.unexplained_px, 0) << offset_mm;
    EXPECT_GT(model.size(), 0.9 * before);  // nor is a young model given up for one such frame
  }
}

TEST(Insertion, WaitsForASecondFrame) {
  PointModel model;
  InsertionMemory memory;
  const PinholeCamera left = smallCamera();
  for (int k = 0; k < 4; ++k) update(takeShot(plane(55), left), {}, &memory, &model);
  const std::size_t before = model.size();
  // Something far in front: what is nearer than buried_mm takes the old surface's place instead.
  update(takeShot(plane(45), left), {}, &memory, &model);
  EXPECT_EQ(model.size(), before);
  update(takeShot(plane(45.5), left), {}, &memory, &model);  // again, and it moves
  EXPECT_GT(model.size(), before + 1000);
}

TEST(Insertion, DoesNotWaitWhereToldSo) {
  FusionOptions options;
  options.insertion.confirm = false;
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < 4; ++k) update(takeShot(plane(55), smallCamera()), options, &memory, &model);
  const std::size_t before = model.size();
  update(takeShot(plane(45), smallCamera()), options, &memory, &model);
  EXPECT_GT(model.size(), before + 1000);
}

TEST(Insertion, GrowsAtTheRimAsTheScopeMoves) {
  PointModel model;
  InsertionMemory memory;
  std::size_t last = 0;
  for (int k = 0; k < 10; ++k) {
    update(takeShot(plane(55), smallCamera(), shifted(0.5 * k, 0, 0)), {}, &memory, &model);
    if (k >= 2) {
      EXPECT_GT(model.size(), last) << k;
    }
    last = model.size();
  }
  // The strip seen twice by frame 9 is 4 mm wider than the picture: 7.07 mm x 13.4 mm.
  EXPECT_NEAR(model.size(), 7.07 * 13.4 / 0.04, 0.1 * 7.07 * 13.4 / 0.04);
}

/// takeShot() makes sigma 3.3e-5 / mm times the square of the depth, at any depth.
TEST(Insertion, NeedsSureDisparity) {
  for (const double depth_mm : {20.0, 55.0, 120.0}) {
    FusionOptions options;
    PointModel model;
    InsertionMemory memory;
    options.insertion.max_sigma_over_square_per_mm = 3.2e-5;
    update(takeShot(plane(depth_mm), smallCamera()), options, &memory, &model);
    EXPECT_TRUE(model.empty()) << depth_mm;
    options.insertion.max_sigma_over_square_per_mm = 3.4e-5;
    update(takeShot(plane(depth_mm), smallCamera()), options, &memory, &model);
    EXPECT_GT(model.size(), 500U) << depth_mm;
  }
}

TEST(Insertion, NeedsSureDepth) {
  Shot shot = takeShot(plane(55), smallCamera());
  for (int v = 0; v < 72; ++v)
    for (int u = 0; u < 48; ++u) shot.depth.sigma_mm.at(u, v) = 0.6f;
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  ASSERT_FALSE(model.empty());
  for (const Eigen::Vector3f& p : model.positions_mm)
    EXPECT_GE(projectPoint<float>(shot.left, p).x(), 47.9f);
}

TEST(Insertion, TakesDepthWithoutErrorsOrColours) {
  Shot shot = takeShot(plane(55), smallCamera());
  shot.depth.sigma_mm = {};
  shot.colour = {};
  PointModel model;
  InsertionMemory memory;
  for (int k = 0; k < 3; ++k) update(shot, {}, &memory, &model);
  EXPECT_NEAR(model.size(), 1666, 120);
  for (const float weight : model.weights) EXPECT_FLOAT_EQ(weight, 3);
}

class BadObservation : public testing::TestWithParam<const char*> {};

Shot spoilt(const std::string& how) {
  Shot shot = takeShot(plane(55), smallCamera());
  const float inf = std::numeric_limits<float>::infinity();
  auto& depth = shot.depth.depth_mm.values;
  if (how == "all NaN") std::fill(depth.begin(), depth.end(), kNoDepth);
  if (how == "all masked") shot.mask = Mask(96, 72, 1);
  if (how == "zero") std::fill(depth.begin(), depth.end(), 0.0f);
  if (how == "negative") std::fill(depth.begin(), depth.end(), -5.0f);
  if (how == "infinite") std::fill(depth.begin(), depth.end(), inf);
  if (how == "huge") std::fill(depth.begin(), depth.end(), 3e38f);
  if (how == "no normals")
    std::fill(shot.normals.values.begin(), shot.normals.values.end(),
              Eigen::Vector3f::Constant(kNoDepth));
  if (how == "no trust")
    std::fill(shot.depth.sigma_mm.values.begin(), shot.depth.sigma_mm.values.end(), kNoDepth);
  return shot;
}

// Nothing to learn: the model stays as it was, byte for byte, and an empty one stays empty.
TEST_P(BadObservation, ChangesNothing) {
  const Shot bad = spoilt(GetParam());
  PointModel model;
  InsertionMemory memory;
  update(bad, {}, &memory, &model);
  EXPECT_TRUE(model.empty());
  update(takeShot(plane(55), smallCamera()), {}, &memory, &model);
  update(takeShot(plane(55), smallCamera()), {}, &memory, &model);
  ASSERT_FALSE(model.empty());
  const PointModel before = model;
  const ModelUpdateSummary summary = update(bad, {}, &memory, &model);
  EXPECT_TRUE(sameModel(before, model));
  EXPECT_EQ(summary.seen, 0);
  const Raster<PixelState> states = classifyPixels(bad.observation(), {});
  EXPECT_EQ(backProjectionError(model, bad.observation(), states).compared_px, 0);
}
INSTANTIATE_TEST_SUITE_P(Spoilt, BadObservation,
                         testing::Values("all NaN", "all masked", "zero", "negative", "infinite",
                                         "huge", "no normals", "no trust"));

TEST(BadModels, LoseTheirBadPointsOnly) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  const std::size_t good = model.size();
  const float inf = std::numeric_limits<float>::infinity();
  for (const float bad : {kNoDepth, inf, -inf, 3e38f, -3e38f})
    model.add({bad, bad, bad}, {0, 0, -1}, {}, 1);
  update(shot, {}, &memory, &model);
  EXPECT_EQ(model.size(), good);
  for (const Eigen::Vector3f& p : model.positions_mm) EXPECT_NEAR(p.z(), 55, 1e-3);
}

TEST(BadModels, ABindingBeyondTheGraphCountsAsUnbound) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  model.add({0, 0, 55.2f}, {0, 0, -1}, {}, 1);
  model.bindings[0] = {12345, {1, 0, 0, 0}};
  InsertionMemory memory;
  EXPECT_NO_THROW(update(shot, {}, &memory, &model));
  EXPECT_LT(model.positions_mm[0].z(), 55.15f);
}

TEST(EmptyPictures, AreRefusedOrHarmless) {
  Shot shot;
  shot.left = {0, 0, 560, 560, 0, 0};
  PointModel model;
  model.add({0, 0, 55}, {0, 0, -1}, {}, 1);
  InsertionMemory memory;
  EXPECT_NO_THROW(update(shot, {}, &memory, &model));
  EXPECT_EQ(model.size(), 1u);
  shot.left = {};
  EXPECT_THROW(update(shot, {}, &memory, &model), OptionError);
}

TEST(BackProjection, IsThePapersMeanOfAbsolutes) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  for (std::size_t i = 0; i < model.size(); ++i)
    model.positions_mm[i].z() += i % 4 == 0 ? -0.3f : 0.1f;
  const Raster<PixelState> states = classifyPixels(shot.observation(), {});
  const BackProjectionError error = backProjectionError(model, shot.observation(), states);
  EXPECT_NEAR(error.compared_px, model.size(), 0.02 * model.size());  // nearly all apart
  EXPECT_NEAR(error.mean_mm, (0.3 + 3 * 0.1) / 4, 2e-3);
  EXPECT_NEAR(error.bias_mm, 0, 2e-3);
  EXPECT_NEAR(error.p95_mm, 0.3, 1e-3);
}

TEST(BackProjection, DoesNotLookThroughTheModel) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  const std::size_t front = model.size();
  for (std::size_t i = 0; i < front; ++i)
    model.add(model.positions_mm[i] + Eigen::Vector3f(0.1f, 0.1f, 5), {0, 0, -1}, {}, 1);
  const Raster<PixelState> states = classifyPixels(shot.observation(), {});
  EXPECT_LT(backProjectionError(model, shot.observation(), states).mean_mm, 1e-3);
}

}  // namespace
}  // namespace softscope::test
