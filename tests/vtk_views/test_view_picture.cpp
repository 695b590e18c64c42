// tests/vtk_views/test_view_picture.cpp: the viewer's picture without a display.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.h"
#include "made_view.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/scenes/render_check.h"
#include "vtk_views/viewer/view_picture.h"
#include "vtk_views/viewer/view_sheet.h"
#include "vtk_views/viewer/x_display.h"

namespace softscope {
namespace {

using namespace test;

class ViewPictures : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("DISPLAY");
    const RenderCheck check = checkRendering();
    if (check.renderer.empty()) GTEST_SKIP() << check.problem;
  }
  ColourImage draw(int index, const ViewState& state, double turn_deg = 0) {
    Playback playback(source);
    playback.goTo(index);
    return picture().draw(playback, state, turn_deg);
  }
  ViewPicture& picture() {
    if (!picture_) picture_ = std::make_unique<ViewPicture>(source, 480, 360);
    return *picture_;
  }

  MadeSource source{4};
  std::unique_ptr<ViewPicture> picture_;
};

TEST_F(ViewPictures, ShowsTheTissueInItsOwnColour) {
  const ColourImage view = draw(0, {});
  EXPECT_EQ(view.width_px, 480);
  EXPECT_EQ(view.height_px, 360);
  // The patch fills most of the height of the part above the foot; no shading changes its red.
  EXPECT_GT(countNear(view, kPatchRed, 2), 15000);
}

TEST_F(ViewPictures, WhatIsSeenFillsTheWindowAndNothingIsCut) {
  for (const bool turning : {false, true}) {
    ViewState state;
    state.turning = turning;
    ViewPicture picture(source, 640, 480, /*clean=*/true);
    Playback playback(source);
    for (const double turn_deg :
         turning ? std::vector<double>{0, 45, 90} : std::vector<double>{0}) {
      const ColourImage view = picture.draw(playback, state, turn_deg);
      int left = view.width_px, right = -1, top = view.height_px, bottom = -1;
      for (int v = 0; v < view.height_px; ++v)
        for (int u = 0; u < view.width_px; ++u)
          if (const Rgb8& c = view.at(u, v); c.red + c.green + c.blue < 740) {
            left = std::min(left, u), right = std::max(right, u);
            top = std::min(top, v), bottom = std::max(bottom, v);
          }
      EXPECT_GT(left, 0);
      EXPECT_GT(top, 0);
      EXPECT_LT(right, view.width_px - 1);
      EXPECT_LT(bottom, view.height_px - 1);
      const double filled =
          std::max(double(right - left) / view.width_px, double(bottom - top) / view.height_px);
      if (!turning) {
        EXPECT_GT(filled, 0.85);
      }
    }
  }
}

TEST_F(ViewPictures, ArrowsAndTipsOfTheModelAreNotCut) {
  class Moving : public MadeSource {
   public:
    Moving() : MadeSource(1) {}
    std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) override {
      auto moment = std::make_shared<ViewMoment>(*MadeSource::moment(index, with_errors));
      moment->node_motion_mm = {{0, 8, 0}};  // an arrow of 32 mm, from above the patch
      for (int i = 0; i < 10; ++i) {         // one in a thousand points
        moment->model.vertices_mm.emplace_back(0, 20 + 0.3f * float(i), 50);
        moment->model.colours.push_back({20, 200, 20});
        moment->weights.push_back(1);
      }
      return moment;
    }
  } moving;
  ViewState state;
  state.motion = true;
  state.scope = false;
  state.look = Look::kFront;
  Playback playback(moving);
  const ColourImage view = ViewPicture(moving, 640, 480, /*clean=*/true).draw(playback, state, 0);
  const auto nearest = [&](Rgb8 colour) {  // to a side, px
    int least = view.width_px;
    for (int v = 0; v < view.height_px; ++v)
      for (int u = 0; u < view.width_px; ++u) {
        const Rgb8& c = view.at(u, v);
        if (std::abs(c.red - colour.red) + std::abs(c.green - colour.green) +
                std::abs(c.blue - colour.blue) <
            60)
          least = std::min({least, u, v, view.width_px - 1 - u, view.height_px - 1 - v});
      }
    return least;
  };
  EXPECT_GT(nearest({235, 30, 35}), 5) << "the arrow";
  EXPECT_LT(nearest({235, 30, 35}), 40);
  EXPECT_LT(nearest({20, 200, 20}), view.width_px) << "the tip";
  EXPECT_GT(nearest({20, 200, 20}), 10) << "has the room that is left around everything";
}

TEST_F(ViewPictures, TheFootTellsWhetherMoreMayCome) {
  const auto going = [this] {
    return footOf(source, *source.moment(0, false), Playback(source), {}, 100, false).going;
  };
  EXPECT_EQ(going(), "");
  source.goOn(4);
  EXPECT_EQ(going(), "live");
  source.stop();
  EXPECT_EQ(going(), "stopped");
}

TEST_F(ViewPictures, TheCameraStaysWhileTheTissueMoves) {
  ViewState front;
  front.look = Look::kFront;
  const double first = meanColumn(draw(0, front), kPatchRed, 2);
  const double second = meanColumn(draw(1, front), kPatchRed, 2);
  EXPECT_GT(second, first + 20);  // 10 mm to the right
}

TEST_F(ViewPictures, TheScopesViewIsTheScopesPicture) {
  ViewState scope;
  scope.look = Look::kScope;
  const ColourImage view = draw(0, scope);
  // Of 640 x 480 pixels with f = 560 the 40 mm at 50 mm are 448 wide; the whole height of 480 is
  // 272 here: 254 columns, as many rows. Dots overlap the rim by a fraction of a millimetre.
  const double side = std::sqrt(countNear(view, kPatchRed, 2));
  EXPECT_NEAR(side, 448 * 272 / 480.0, 6);
  EXPECT_NEAR(meanColumn(view, kPatchRed, 2), 239.5, 2);
}

TEST_F(ViewPictures, APrincipalPointBesideTheMiddleMovesTheView) {
  class Shifted : public MadeSource {
   public:
    Shifted() : MadeSource(1) { other_.left = {640, 480, 560, 560, 399.5, 239.5}; }
    const ViewWorld& world() const override { return other_; }

   private:
    ViewWorld other_;
  } shifted;
  ViewState scope;
  scope.look = Look::kScope;
  Playback playback(shifted);
  const ColourImage view = ViewPicture(shifted, 480, 360).draw(playback, scope, 0);
  EXPECT_NEAR(meanColumn(view, kPatchRed, 2), 239.5 + 80 * 272 / 480.0, 3);
}

TEST_F(ViewPictures, ErrorsAndWeightsHaveTheBarsColours) {
  ViewState errors;
  errors.colour = ViewColour::kErrors;
  EXPECT_GT(countNear(draw(0, errors), viridis(0.5), 3), 15000);  // 0.1 of 0.2 mm
  EXPECT_EQ(countNear(draw(1, errors), viridis(0.5), 3), 0) << "no errors are known there";
  ViewState weights;
  weights.colour = ViewColour::kWeights;
  const ColourImage view = draw(0, weights);
  EXPECT_GT(countNear(view, viridis(0.05), 8), 200);
  EXPECT_GT(countNear(view, viridis(0.95), 8), 200);
}

TEST_F(ViewPictures, NodesScopeAndHelpAreThereWhereWanted) {
  ViewState bare;
  bare.scope = false;
  ViewState with = bare;
  with.nodes = true;
  EXPECT_GT(countNear(draw(0, with), {20, 60, 200}, 30),
            countNear(draw(0, bare), {20, 60, 200}, 30));
  with = bare;
  with.scope = true;
  EXPECT_GT(countNear(draw(0, with), {20, 20, 20}, 60),
            countNear(draw(0, bare), {20, 20, 20}, 60) + 100);
  with = bare;
  with.help = true;
  EXPECT_LT(countNear(draw(0, with), kPatchRed, 2), countNear(draw(0, bare), kPatchRed, 2) / 2);
}

TEST_F(ViewPictures, TurningChangesThePictureAndAWholeTurnDoesnt) {
  const ColourImage before = draw(0, {});
  EXPECT_NE(draw(0, {}, 30).values, before.values);
  EXPECT_EQ(draw(0, {}, 360).values, before.values);
}

TEST_F(ViewPictures, ImpossibleSizesAreRefused) {
  EXPECT_THROW(ViewPicture(source, 100, 360), OptionError);
  EXPECT_THROW(ViewPicture(source, 480, 5000), OptionError);
}

TEST(ViewDisplay, WithoutADisplayTheErrorTellsWhatWorks) {
  unsetenv("DISPLAY");
  try {
    connectToDisplay();
    FAIL() << "there is none";
  } catch (const BackendError& error) {
    EXPECT_NE(std::string(error.what()).find("`screenshot=`"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("`movie=`"), std::string::npos);
  }
  setenv("DISPLAY", ":4999", 1);
  EXPECT_THROW(connectToDisplay(), BackendError);
  unsetenv("DISPLAY");
}

}  // namespace
}  // namespace softscope
