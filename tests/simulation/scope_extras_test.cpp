// tests/simulation/scope_extras_test.cpp: instrument, shutter, smoke, blood, events, misalignment,
// flow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/simulation/sequence/simulator.h"

namespace softscope {
namespace {

SimulationOptions small() {
  SimulationOptions options;
  options.scope.width_px = 120;
  options.scope.height_px = 90;
  options.organ.cells_per_side = 24;
  options.sensor.noise = options.sensor.shot_noise = 0;
  options.camera.tremor_mm = 0;
  options.texture.vessels.trunk_radius_mm = 0;  // they take longest to grow
  return options;
}

SimulatedFrame frameOf(const SimulationOptions& options, int index, bool flow = false) {
  return Simulator(makeOrganMesh(options.organ, 1), options).frame(index, flow);
}

double meanDifference(const ColourImage& a, const ColourImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(int(a.values[i].green) - int(b.values[i].green));
  return sum / double(a.size());
}

double meanOf(const ColourImage& a, std::uint8_t Rgb8::*channel) {
  double sum = 0;
  for (const Rgb8& pixel : a.values) sum += pixel.*channel;
  return sum / double(a.size());
}

/// Contrast of neighbours along rows.
double sharpness(const ColourImage& a) {
  double sum = 0;
  for (int v = 0; v < a.height_px; ++v)
    for (int u = 1; u < a.width_px; ++u)
      sum += std::abs(int(a.at(u, v).green) - int(a.at(u - 1, v).green));
  return sum;
}

TEST(Instrument, HidesTissueFromDepthAndTracksAndLooksGrey) {
  SimulationOptions options = small();
  options.instrument.radius_mm = 4;
  const SimulatedFrame with = frameOf(options, 0);
  options.instrument.radius_mm = 0;
  const SimulatedFrame without = frameOf(options, 0);
  EXPECT_TRUE(without.instrument.empty());
  const auto hidden = std::count(with.instrument.values.begin(), with.instrument.values.end(), 255);
  EXPECT_GT(hidden, 120 * 90 / 50);
  EXPECT_LT(hidden, 120 * 90 / 2);
  for (std::size_t i = 0; i < with.instrument.size(); ++i) {
    EXPECT_EQ(std::isfinite(with.depth_mm.values[i]),
              with.instrument.values[i] == 0 && std::isfinite(without.depth_mm.values[i]));
    if (with.instrument.values[i] == 0) continue;
    const Rgb8 steel = with.pictures.left.values[i];
    EXPECT_LT(steel.red - steel.blue, 60) << "half a pixel of tissue may shine through at its rim";
  }
  EXPECT_EQ(std::count(without.tracks_visible.begin(), without.tracks_visible.end(), false), 0);
  EXPECT_EQ(std::count(with.tracks_visible.begin(), with.tracks_visible.end(), false), 0);
  EXPECT_LT(with.tracks_visible.size(), without.tracks_visible.size())
      << "only tissue in sight is tracked";
}

TEST(Instrument, HidesTrackedTissueAsItMoves) {
  SimulationOptions options = small();
  options.instrument.radius_mm = 4;
  options.instrument.amplitude_mm = 15;
  Simulator simulator(makeOrganMesh(options.organ, 1), options);
  int hidden = 0;
  for (const int index : {15, 47}) {  // out and in: a quarter and three quarters of its period
    const auto visible = simulator.frame(index).tracks_visible;
    hidden += int(std::count(visible.begin(), visible.end(), false));
  }
  EXPECT_GT(hidden, 0);
}

TEST(Instrument, StandsBeforeTheTissueInBothPictures) {
  SimulationOptions options = small();
  options.instrument.radius_mm = 4;
  const SimulatedFrame with = frameOf(options, 0);
  options.instrument.radius_mm = 0;
  const SimulatedFrame without = frameOf(options, 0);
  EXPECT_GT(meanDifference(with.pictures.right, without.pictures.right), 2);
}

TEST(Shutter, BlursWhatMovesAndLeavesWhatIsStill) {
  SimulationOptions moving = small(), open = small();
  moving.camera.amplitude_mm = open.camera.amplitude_mm = 20;
  moving.camera.period_s = open.camera.period_s = 1;
  open.sensor.shutter = 1;
  const SimulatedFrame blurred = frameOf(open, 25), frozen = frameOf(moving, 25);
  EXPECT_LT(sharpness(blurred.pictures.left), 0.9 * sharpness(frozen.pictures.left));
  EXPECT_EQ(blurred.vertices_world_mm, frozen.vertices_world_mm);

  SimulationOptions still = small();
  still.camera.path = "still";
  still.deformation.breathing.amplitude_mm = still.deformation.heartbeat.amplitude_mm =
      still.deformation.push.amplitude_mm = 0;
  const SimulatedFrame sharp = frameOf(still, 3);
  still.sensor.shutter = 1;
  // The mean of seven equal pictures: rounding may move a value by one.
  EXPECT_LT(meanDifference(sharp.pictures.left, frameOf(still, 3).pictures.left), 0.01);
}

// The scope passes its start again after a period, in the same direction.
TEST(Shutter, IsOpenBeforeAndAfterTheTimeOfTheFirstFrameToo) {
  SimulationOptions options = small();
  options.deformation.breathing.amplitude_mm = options.deformation.heartbeat.amplitude_mm =
      options.deformation.push.amplitude_mm = 0;
  options.camera.amplitude_mm = 20;
  options.camera.period_s = 1;
  options.sensor.shutter = 1;
  const ColourImage first = frameOf(options, 0).pictures.left;
  EXPECT_LT(meanDifference(first, frameOf(options, 25).pictures.left), 0.01);
}

TEST(Smoke, TakesContrastAndAddsGrey) {
  SimulationOptions options = small();
  const ColourImage clear = frameOf(options, 0).pictures.left;
  options.smoke = 1;
  const ColourImage smoky = frameOf(options, 0).pictures.left;
  EXPECT_LT(sharpness(smoky), 0.75 * sharpness(clear));
  EXPECT_GT(sharpness(smoky), 0.2 * sharpness(clear));
}

TEST(Blood, CoversTissueWithDarkRed) {
  SimulationOptions options = small();
  const ColourImage clean = frameOf(options, 0).pictures.left;
  options.texture.blood = 0.5;
  const ColourImage bloody = frameOf(options, 0).pictures.left;
  EXPECT_LT(meanOf(bloody, &Rgb8::green), 0.9 * meanOf(clean, &Rgb8::green));
}

TEST(Misalignment, MovesTheRightPictureAloneAndByWhatItSays) {
  SimulationOptions options = small();
  const SimulatedFrame right_one = frameOf(options, 0);
  options.scope.row_error_px = 2;
  const SimulatedFrame off = frameOf(options, 0);
  EXPECT_EQ(off.pictures.left.values, right_one.pictures.left.values);
  double moved = 0, same = 0;
  for (int v = 10; v < 80; ++v)
    for (int u = 10; u < 110; ++u) {
      const int seen = off.pictures.right.at(u, v + 2).green;
      moved += std::abs(seen - right_one.pictures.right.at(u, v).green);
      same += std::abs(seen - right_one.pictures.right.at(u, v + 2).green);
    }
  EXPECT_LT(moved, 0.4 * same) << "vignetting stays where it is, so they differ a little";
}

TEST(Flow, LeadsToWhereTheTissueIsSeenNext) {
  const SimulationOptions options = small();
  Simulator simulator(makeOrganMesh(options.organ, 1), options);
  const SimulatedFrame now = simulator.frame(4, true), next = simulator.frame(5);
  ASSERT_FALSE(now.flow_px.empty());
  EXPECT_TRUE(next.flow_px.empty());
  int judged = 0;
  for (std::size_t id = 0; id < now.tracks_world_mm.size(); ++id) {
    const auto pixelOf = [&](const SimulatedFrame& frame) -> Eigen::Vector2d {
      return projectPoint(simulator.rig().left,
                          frame.pose.world_from_left.inverse() * frame.tracks_world_mm[id]);
    };
    const Eigen::Vector2d from = pixelOf(now), to = pixelOf(next);
    const int u = int(std::lround(from.x())), v = int(std::lround(from.y()));
    if (u < 0 || v < 0 || u >= 120 || v >= 90 || !now.tracks_visible[id]) continue;
    // Flow is of the pixel's middle, half a pixel away at most: it changes by a few hundredths.
    EXPECT_LT((now.flow_px.at(u, v).cast<double>() - (to - from)).norm(), 0.1);
    ++judged;
  }
  EXPECT_GT(judged, 5);
}

TEST(Jerk, GoesQuicklyAndRests) {
  CameraPathOptions options;
  options.path = "jerk";
  options.amplitude_mm = 10;
  options.period_s = 1;
  options.tremor_mm = 0;
  const CameraPath path(options, {0, 0, 0}, 5, 3);
  const auto at = [&](double time_s) -> Eigen::Vector3d {
    return path.bodyFromLeft(time_s).translation();
  };
  EXPECT_LT((at(0.99) - at(0.0)).norm(), 1e-9) << "the first rest is the start";
  EXPECT_GT((at(1.3) - at(0.9)).norm(), 4);
  EXPECT_LE((at(1.3) - at(0.9)).norm(), 10 + 1e-9);
  EXPECT_LT((at(1.99) - at(1.3)).norm(), 1e-9);
  EXPECT_LT((at(1.001) - at(0.999)).norm(), 0.01) << "no jump";
}

double brightness(const ColourImage& a) { return meanOf(a, &Rgb8::green); }

// 25 frames a second: frame 12 is before the event, 37 in its middle, 70 after it.
TEST(ScopeEvent, TakesTheTissueOutOfSightAndGivesItBack) {
  SimulationOptions options = small();
  const ColourImage before = frameOf(options, 12).pictures.left;
  const ColourImage middle = frameOf(options, 37).pictures.left;
  const ColourImage after = frameOf(options, 70).pictures.left;
  for (const char* kind : {"withdraw", "cover", "wipe", "smoke"}) {
    options.event = {kind, 0.8, 1.4};
    EXPECT_EQ(frameOf(options, 12).pictures.left.values, before.values) << kind;
    EXPECT_LT(sharpness(frameOf(options, 37).pictures.left), 0.15 * sharpness(middle)) << kind;
    EXPECT_EQ(frameOf(options, 70).pictures.left.values, after.values) << kind;
  }
  options.event.kind = "withdraw";
  EXPECT_LT(brightness(frameOf(options, 37).pictures.left), 5);
  options.event.kind = "wipe";
  EXPECT_GT(brightness(frameOf(options, 37).pictures.left), 1.5 * brightness(middle));
}

TEST(ScopeEvent, ReturnsToAnotherPlace) {
  SimulationOptions options = small();
  const Eigen::Isometry3d before = frameOf(options, 70).pose.world_from_left;
  options.event = {"withdraw", 0.8, 1.4, 6, 20};
  const Eigen::Isometry3d moved = before.inverse() * frameOf(options, 70).pose.world_from_left;
  EXPECT_LT((moved.translation() - Eigen::Vector3d(6, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(Eigen::AngleAxisd(moved.linear()).angle() * 180 / M_PI, 20, 1e-6);
}

TEST(ScopeEvent, RisesAndFallsWithoutJumps) {
  const ScopeEventOptions event{"cover", 1, 2};
  EXPECT_EQ(event.shareAt(1), 0);
  EXPECT_EQ(event.shareAt(2), 1);
  EXPECT_EQ(event.shareAt(3), 0);
  for (double t = 0.9; t < 3.1; t += 0.001)
    EXPECT_LT(std::abs(event.shareAt(t + 0.001) - event.shareAt(t)), 0.01);
}

TEST(Extras, RefuseWhatCannotBe) {
  const auto refuses = [](auto change) {
    SimulationOptions options = small();
    change(options);
    EXPECT_THROW(frameOf(options, 0), OptionError);
  };
  refuses([](SimulationOptions& o) { o.instrument.radius_mm = 0.1; });
  refuses([](SimulationOptions& o) { o.instrument.reach = 2; });
  refuses([](SimulationOptions& o) { o.smoke = -1; });
  refuses([](SimulationOptions& o) { o.event.kind = "sneeze"; });
  refuses([](SimulationOptions& o) { o.event.start_s = 0; });
  refuses([](SimulationOptions& o) { o.event.length_s = -1; });
  refuses([](SimulationOptions& o) { o.sensor.shutter = 1.5; });
  refuses([](SimulationOptions& o) { o.texture.blood = 2; });
  refuses([](SimulationOptions& o) { o.scope.roll_error_deg = 10; });
  refuses([](SimulationOptions& o) { o.deformation.push_kind = "rigid"; });
}

}  // namespace
}  // namespace softscope
