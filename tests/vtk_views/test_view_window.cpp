// tests/vtk_views/test_view_window.cpp: the window on a screen in memory, driven by events.
#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkRenderWindow.h>

#include "core/error.h"
#include "made_view.h"
#include "support/x_server.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/viewer/view_sheet.h"
#include "vtk_views/viewer/view_window.h"

namespace softscope {
namespace {

using namespace test;

class ViewWindows : public testing::Test {
 protected:
  void SetUp() override {
    if (!server.problem().empty()) GTEST_SKIP() << server.problem();
    options.width_px = 480;
    options.height_px = 360;
    options.save = [this](const ColourImage& picture, int frame) {
      saved = picture;
      saved_frame = frame;
    };
  }
  void open() { window = std::make_unique<ViewWindow>(source, options); }
  void TearDown() override { window.reset(); }
  void press(const char* key) {
    window->interactor()->SetKeySym(key);
    window->interactor()->InvokeEvent(vtkCommand::KeyPressEvent);
  }
  void mouse(unsigned long event, int x_px, int y_px) {
    window->interactor()->SetEventInformation(x_px, y_px, 0, 0, 0, 0, nullptr);
    window->interactor()->InvokeEvent(event);
  }

  XServer server;
  MadeSource source{5};
  ViewWindowOptions options;
  std::unique_ptr<ViewWindow> window;
  ColourImage saved;
  int saved_frame = -1;
};

TEST_F(ViewWindows, OpensAndShowsTheTissueAboveItsFoot) {
  open();
  const ColourImage view = window->pixels();
  EXPECT_EQ(view.width_px, 480);
  EXPECT_EQ(view.height_px, 360);
  EXPECT_GT(countNear(view, kPatchRed, 2), 15000);
  // The slider's blue knob at the left end, and words in the foot.
  EXPECT_NEAR(view.at(14, 360 - kViewFootPx + 15).blue, 170, 2);
  EXPECT_GT(countNear(view, {20, 20, 20}, 40), 200);
}

TEST_F(ViewWindows, KeysStepAndColour) {
  open();
  press("f");
  const double first = meanColumn(window->pixels(), kPatchRed, 2);
  press("Right");
  EXPECT_EQ(window->playback().index(), 1);
  EXPECT_GT(meanColumn(window->pixels(), kPatchRed, 2), first + 20);
  press("Home");
  press("c");
  EXPECT_EQ(window->state().colour, ViewColour::kErrors);
  EXPECT_GT(countNear(window->pixels(), viridis(0.5), 3), 10000);
}

TEST_F(ViewWindows, ScreenshotsAreWhatIsOnScreen) {
  open();
  press("Right");
  press("h");
  press("s");
  EXPECT_EQ(saved_frame, 10);
  EXPECT_EQ(saved.values, window->pixels().values);
  press("h");
  EXPECT_NE(saved.values, window->pixels().values) << "the card with the keys has gone";
}

TEST_F(ViewWindows, TheMouseTurnsTheModelAndMovesTheSlider) {
  open();
  press("v");
  const ColourImage before = window->pixels();
  mouse(vtkCommand::LeftButtonPressEvent, 240, 200);
  mouse(vtkCommand::MouseMoveEvent, 300, 220);
  mouse(vtkCommand::LeftButtonReleaseEvent, 300, 220);
  EXPECT_NE(window->pixels().values, before.values);
  EXPECT_EQ(window->state().look, Look::kFree) << "who turns the scope's view leaves it";
  mouse(vtkCommand::LeftButtonPressEvent, 240, kViewFootPx - 15);  // VTK counts from below
  mouse(vtkCommand::LeftButtonReleaseEvent, 240, kViewFootPx - 15);
  EXPECT_EQ(window->playback().index(), 2);
}

TEST_F(ViewWindows, PlaysThenCloses) {
  options.playing = true;
  options.speed = 16;  // the clip lasts 0.125 s
  options.closes = [this] { return window && !window->playback().playing; };
  open();
  window->run();
  EXPECT_EQ(window->playback().index(), 4);
  EXPECT_GE(window->pace().pictures, 2);
}

TEST_F(ViewWindows, FollowsARunThatGrows) {
  source.goOn(7);
  options.first = 4;
  options.closes = [this] { return window && window->playback().index() == 6; };
  open();
  window->run();  // ends when the new model is shown
  EXPECT_EQ(window->playback().index(), 6);
}

TEST_F(ViewWindows, AModelThatCantBeReadEndsItWithTheReason) {
  class Damaged : public MadeSource {
   public:
    using MadeSource::MadeSource;
    std::shared_ptr<const ViewMoment> moment(int index, bool with_errors) override {
      if (index == 1) throw InputError("models/000010.ply: is cut short");
      return MadeSource::moment(index, with_errors);
    }
  } damaged(3);
  options.playing = true;
  window = std::make_unique<ViewWindow>(damaged, options);
  EXPECT_THROW(window->run(), InputError);
  window.reset();
}

}  // namespace
}  // namespace softscope
