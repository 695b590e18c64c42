// tests/fusion/colour_test.cpp: colours follow the tissue, not the light.
#include <gtest/gtest.h>

#include "fusion/colour_gain.h"
#include "fusion/colour_levels.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

constexpr Rgb8 kTissue{150, 90, 80};

PointModel modelOf(const Surface& surface, const FusionOptions& options, InsertionMemory* memory,
                   int frames = 5) {
  PointModel model;
  for (int k = 0; k < frames; ++k)
    update(takeShot(surface, smallCamera()), options, memory, &model);
  return model;
}

int largestDifference(const PointModel& model, Rgb8 colour) {
  int largest = 0;
  for (const Rgb8 c : model.colours)
    largest = std::max({largest, std::abs(c.red - colour.red), std::abs(c.green - colour.green),
                        std::abs(c.blue - colour.blue)});
  return largest;
}

TEST(Colour, KeepsTheModelsExposureWhenTheCamerasChanges) {
  InsertionMemory memory;
  PointModel model = modelOf(plane(55), {}, &memory);
  // 0.8 in red and green, 0.7 in blue, rounded: within half a level of 90, so 1 % of gain.
  Shot darker = takeShot(plane(55), smallCamera(), shifted(0, 0, 0), 3.3e-5, {120, 72, 56});
  const ModelUpdateSummary summary = update(darker, {}, &memory, &model);
  EXPECT_NEAR(summary.points.gain.red, 0.8, 0.01);
  EXPECT_NEAR(summary.points.gain.green, 0.8, 0.01);
  EXPECT_NEAR(summary.points.gain.blue, 0.7, 0.01);
  EXPECT_LE(largestDifference(model, kTissue), 2);
}

TEST(Colour, FollowsTissueThatChangesInPlaces) {
  InsertionMemory memory;
  PointModel model = modelOf(plane(55), {}, &memory);
  Shot bleeding = takeShot(plane(55), smallCamera());
  for (int v = 20; v < 40; ++v)
    for (int u = 20; u < 40; ++u) bleeding.colour.at(u, v) = {90, 10, 10};
  for (int k = 0; k < 20; ++k) update(bleeding, {}, &memory, &model);
  int red = 0;
  for (const Rgb8 c : model.colours) red += c.green < 16;
  EXPECT_NEAR(red, 20 * 20 / 4.15, 25);  // 4.15 pixels a cell of 0.2 mm
}

TEST(Colour, IgnoresHighlights) {
  InsertionMemory memory;
  PointModel model = modelOf(plane(55), {}, &memory);
  Shot glaring = takeShot(plane(55), smallCamera());
  for (int v = 10; v < 40; ++v)
    for (int u = 10; u < 40; ++u)  // the light itself, and its glow
      glaring.colour.at(u, v) = u < 25 ? Rgb8{255, 250, 240} : Rgb8{210, 160, 150};
  for (int k = 0; k < 10; ++k) update(glaring, {}, &memory, &model);
  EXPECT_LE(largestDifference(model, kTissue), 1);
}

TEST(Colour, GetsRidOfAHighlightThatWasThereFirst) {
  InsertionMemory memory;
  PointModel model;
  Shot glaring = takeShot(plane(55), smallCamera());
  for (int u = 10; u < 40; ++u) glaring.colour.at(u, 30) = {250, 250, 250};
  update(glaring, {}, &memory, &model);
  for (int k = 0; k < 20; ++k) update(takeShot(plane(55), smallCamera()), {}, &memory, &model);
  EXPECT_LE(largestDifference(model, kTissue), 3);  // steps below half a level end the average
}

/// A plane whose red grows by 16 levels a pixel, fixed to the world, in the picture's middle.
Shot rampShot(double camera_x_mm) {
  Shot shot = takeShot(plane(55), smallCamera(), shifted(camera_x_mm, 0, 0));
  for (int v = 0; v < 72; ++v)
    for (int u = 0; u < 96; ++u) {
      const double column = u + camera_x_mm * 560 / 55 - 40;
      shot.colour.at(u, v).red = static_cast<std::uint8_t>(std::clamp(16 * column, 0.0, 240.0));
    }
  return shot;
}

// Half a pixel aside, the nearest pixel is 8 levels off; between pixels the ramp is exact, and
// averages in steps of 8 bits stall within 2 levels.
TEST(Colour, IsReadBetweenPixels) {
  FusionOptions options;
  options.colour.compensate_gain = false;
  options.colour.highlight_level = 255;
  InsertionMemory memory;
  PointModel model;
  update(rampShot(0), options, &memory, &model);
  const PointModel before = model;
  for (int k = 0; k < 20; ++k) update(rampShot(0.5 * 55 / 560), options, &memory, &model);
  ASSERT_GE(model.size(), before.size());
  int judged = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const int red = before.colours[i].red;
    if (red < 32 || red > 208) continue;  // away from the ramp's ends
    EXPECT_NEAR(model.colours[i].red, red, 3) << i;
    ++judged;
  }
  EXPECT_GT(judged, 100);
}

// A texture that slips by half a pixel in every frame takes the colours with it, but not what
// matches hold on to: 16 levels a pixel, and steps below 20 levels are no change of the tissue.
TEST(Anchor, StaysWhereColoursSlip) {
  FusionOptions options;
  options.colour.compensate_gain = false;
  InsertionMemory memory;
  PointModel model;
  const auto rampAt = [](double slip_px) {
    Shot shot = takeShot(plane(55), smallCamera());
    for (int v = 0; v < 72; ++v)
      for (int u = 0; u < 96; ++u) {
        const double gray = std::clamp(40 + 4 * (u - slip_px), 0.0, 220.0);
        shot.colour.at(u, v).red = shot.colour.at(u, v).green = shot.colour.at(u, v).blue =
            static_cast<std::uint8_t>(gray);
      }
    return shot;
  };
  update(rampAt(0), options, &memory, &model);
  const PointModel before = model;
  for (int k = 1; k <= 8; ++k) update(rampAt(0.5 * k), options, &memory, &model);
  int judged = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before.colours[i].red < 60 || before.colours[i].red > 200) continue;
    EXPECT_EQ(model.anchors[i], before.anchors[i]);
    EXPECT_LT(model.colours[i].red, before.colours[i].red - 6);  // 16 levels off at the end
    ++judged;
  }
  EXPECT_GT(judged, 100);
}

// Tissue with a permanent change is anchored again, to within the steps that count.
TEST(Anchor, FollowsALastingChange) {
  InsertionMemory memory;
  FusionOptions options;
  options.colour.compensate_gain = false;
  PointModel model = modelOf(plane(55), options, &memory);
  const std::uint8_t first = model.anchors[0];
  const Rgb8 pale{190, 190, 190};
  for (int k = 0; k < 120; ++k)
    update(takeShot(plane(55), smallCamera(), shifted(0, 0, 0), 3.3e-5, pale), options, &memory,
           &model);
  EXPECT_LT(first, 150);
  for (const std::uint8_t anchor : model.anchors) ASSERT_GT(anchor, 190 - 22);
}

TEST(Colour, ThePaperTakesTheLatest) {
  InsertionMemory memory;
  const FusionOptions paper = FusionOptions::paper();
  PointModel model = modelOf(plane(55), paper, &memory);
  update(takeShot(plane(55), smallCamera(), shifted(0, 0, 0), 3.3e-5, {10, 20, 30}), paper, &memory,
         &model);
  EXPECT_EQ(largestDifference(model, {10, 20, 30}), 0);
  for (const std::uint8_t anchor : model.anchors) ASSERT_EQ(anchor, toGray(Rgb8{10, 20, 30}));
}

TEST(Gain, IsOneForAnEmptyModel) {
  const Shot shot = takeShot(plane(55), smallCamera());
  const ColourGain gain = estimateGain({}, shot.observation(), {}, {});
  EXPECT_EQ(gain.red, 1);
  EXPECT_EQ(gain.green, 1);
  EXPECT_EQ(gain.blue, 1);
}

}  // namespace
}  // namespace softscope::test
