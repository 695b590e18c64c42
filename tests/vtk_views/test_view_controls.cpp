// tests/vtk_views/test_view_controls.cpp: keys, clock and slider, without a window.
#include <gtest/gtest.h>

#include "made_view.h"
#include "vtk_views/viewer/moment_between.h"
#include "vtk_views/viewer/view_controls.h"
#include "vtk_views/viewer/view_sheet.h"

namespace softscope {
namespace {

using test::MadeSource;

class ViewControls : public testing::Test {
 protected:
  ViewTask press(const std::string& key) { return pressKey(key, source.world(), playback, state); }

  MadeSource source{5};  // moments at 0, 0.4 … 1.6 s; the last one stays until 2.0 s
  Playback playback{source};
  ViewState state;
};

TEST_F(ViewControls, PlaysByTheClipsClock) {
  press("space");
  EXPECT_FALSE(playback.pass(0.39));
  EXPECT_TRUE(playback.pass(0.02));
  EXPECT_EQ(playback.index(), 1);
  EXPECT_TRUE(playback.pass(0.8));  // a slow computer leaves moments out, not time
  EXPECT_EQ(playback.index(), 3);
}

TEST_F(ViewControls, StopsAfterTheLastMomentHasHadItsTime) {
  playback.playing = true;
  playback.pass(1.99);
  EXPECT_EQ(playback.index(), 4);
  EXPECT_TRUE(playback.playing);
  EXPECT_TRUE(playback.pass(0.02));  // the foot must show that it stopped
  EXPECT_FALSE(playback.playing);
  press("space");
  EXPECT_EQ(playback.index(), 0) << "playing again begins at the beginning";
}

TEST_F(ViewControls, LoopsAndDoublesItsSpeed) {
  press("l");
  press("Up");
  press("space");
  EXPECT_EQ(playback.speed, 2);
  playback.pass(0.95);
  EXPECT_EQ(playback.index(), 4);
  playback.pass(0.1);
  EXPECT_EQ(playback.index(), 0);
  EXPECT_TRUE(playback.playing);
}

TEST_F(ViewControls, BetweenModelsTimeGoesOnSmoothly) {
  EXPECT_EQ(playback.share(), 0);
  press("space");
  playback.pass(0.1);
  EXPECT_NEAR(playback.share(), 0.25, 1e-9);
  const auto shown = shownMoment(source, playback, /*with_errors=*/true);
  EXPECT_EQ(shown->frame, 0);
  EXPECT_NEAR(shown->time_s, 0.1, 1e-9);
  // The patch and its node go 10 mm to the right until the next model: a quarter of that by now.
  const auto first = source.moment(0, true);
  ASSERT_EQ(shown->model.vertices_mm.size(), first->model.vertices_mm.size());
  for (std::size_t i = 0; i < first->model.vertices_mm.size(); i += 999)
    EXPECT_NEAR(shown->model.vertices_mm[i].x() - first->model.vertices_mm[i].x(), 2.5, 1e-4);
  EXPECT_NEAR(shown->judged.vertices_mm[0].x() - first->judged.vertices_mm[0].x(), 2.5, 1e-4);
  EXPECT_NEAR(shown->nodes_mm[0].x(), 2.5, 1e-4);
  EXPECT_EQ(shown->errors_mm, first->errors_mm) << "nothing is measured between models";
  press("Right");
  EXPECT_EQ(playback.share(), 0) << "a step leads to a model itself";
  playback.goToTime(1.0);
  EXPECT_EQ(playback.index(), 2);
  EXPECT_NEAR(playback.share(), 0.5, 1e-9);
  playback.goToTime(1.9);
  EXPECT_EQ(playback.share(), 0) << "nothing follows the last model";
}

TEST(MomentBetween, TheScopeTurnsAndMovesEvenly) {
  ViewMoment from, to;
  from.world_from_left = to.world_from_left = Eigen::Isometry3d::Identity();
  to.world_from_left->linear() =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix();
  to.world_from_left->translation().z() = 8;
  from.model.vertices_mm = {{1, 2, 3}};
  const ViewMoment half = momentBetween(from, to, 0.5);
  EXPECT_NEAR(Eigen::AngleAxisd(half.world_from_left->linear()).angle(), 0.2, 1e-9);
  EXPECT_NEAR(half.world_from_left->translation().z(), 4, 1e-9);
  EXPECT_EQ(half.model.vertices_mm, from.model.vertices_mm) << "no nodes, no motion";
}

TEST_F(ViewControls, StepsStopAtTheEnds) {
  playback.playing = true;
  EXPECT_EQ(press("Right"), ViewTask::kRedraw);
  EXPECT_EQ(playback.index(), 1);
  EXPECT_FALSE(playback.playing);
  press("Prior");
  EXPECT_EQ(playback.index(), 0);
  press("Next");
  EXPECT_EQ(playback.index(), 4);
  press("Home");
  press("End");
  EXPECT_EQ(playback.index(), 4);
}

TEST_F(ViewControls, FollowsALiveRunOnlyFromItsEnd) {
  source.goOn(8);
  playback.goTo(4);
  source.look();
  EXPECT_TRUE(playback.follow(5));
  EXPECT_EQ(playback.index(), 7);
  playback.goTo(2);  // a selected past frame is kept
  source.goOn(9);
  source.look();
  EXPECT_FALSE(playback.follow(8));
  EXPECT_EQ(playback.index(), 2);
}

TEST_F(ViewControls, PlayingALiveRunWaitsForMore) {
  source.goOn(6);
  playback.goTo(4);
  press("space");
  playback.pass(10);
  EXPECT_TRUE(playback.playing);
  source.look();
  playback.pass(0.41);
  EXPECT_EQ(playback.index(), 5);
}

TEST_F(ViewControls, CyclesThroughTheColoursThatThereAre) {
  press("c");
  EXPECT_EQ(state.colour, ViewColour::kErrors);
  press("c");
  EXPECT_EQ(state.colour, ViewColour::kWeights);
  press("c");
  EXPECT_EQ(state.colour, ViewColour::kTexture);
  ViewWorld bare;
  pressKey("2", bare, playback, state);
  EXPECT_EQ(state.colour, ViewColour::kTexture) << "no errors are known";
}

TEST_F(ViewControls, TurnsThingsOnAndOff) {
  for (const char* key : {"n", "a", "g", "m", "k", "h"})
    EXPECT_EQ(press(key), ViewTask::kRedraw) << key;
  EXPECT_TRUE(state.nodes && state.motion && state.help);
  EXPECT_FALSE(state.scope || state.reference || state.ct);
  EXPECT_EQ(press("v"), ViewTask::kLook);
  EXPECT_EQ(state.look, Look::kScope);
  EXPECT_EQ(press("s"), ViewTask::kScreenshot);
  EXPECT_EQ(press("q"), ViewTask::kQuit);
  EXPECT_EQ(press("F7"), ViewTask::kNothing);
}

TEST(ViewSheet, TheSliderFindsTheNearestMoment) {
  const std::vector<double> places{0, 0.25, 1};
  EXPECT_EQ(nearestMoment(places, 0.1), 0);
  EXPECT_EQ(nearestMoment(places, 0.2), 1);
  EXPECT_EQ(nearestMoment(places, 0.6), 1);
  EXPECT_EQ(nearestMoment(places, 0.99), 2);
  EXPECT_EQ(sliderPlace(0, 640), 0);
  EXPECT_EQ(sliderPlace(640, 640), 1);
  EXPECT_NEAR(sliderPlace(320, 640), 0.5, 1e-9);
}

}  // namespace
}  // namespace softscope
