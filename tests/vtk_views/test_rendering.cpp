// tests/vtk_views/test_rendering.cpp: pictures without a display.
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>

#include "vtk_views/fonts.h"
#include "vtk_views/offscreen_window.h"
#include "vtk_views/render_check.h"

namespace softscope {
namespace {

class Rendering : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("DISPLAY");  // a display must not be needed even where there is one
    check = checkRendering();
    if (check.renderer.empty()) GTEST_SKIP() << check.problem;
  }
  RenderCheck check;
};

int blueOf(vtkRenderWindow* window) {
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(4, 4, 4, 4, 0, pixel);
  return pixel->GetValue(2);
}

TEST_F(Rendering, DrawsTheSceneThatTheCheckExpects) {
  EXPECT_TRUE(check.works) << check.problem;
  EXPECT_GT(check.first_frame_ms, 0);
  EXPECT_NE(check.renderer.find("EGL"), std::string::npos);
}

TEST_F(Rendering, ClosingOneWindowLeavesTheOthersAlive) {
  const auto first = makeOffscreenWindow(16, 16);
  vtkNew<vtkRenderer> blue;
  blue->SetBackground(0, 0, 1);
  first->AddRenderer(blue);
  { const auto second = makeOffscreenWindow(16, 16); }
  first->Render();
  EXPECT_EQ(blueOf(first), 255);
}

TEST_F(Rendering, TheFactoryMakesPlainWindowsDisplayless) {
  installOffscreenFactory();
  vtkNew<vtkRenderWindow> window;  // the stock one would abort this process
  vtkNew<vtkRenderer> blue;
  blue->SetBackground(0, 0, 1);
  window->AddRenderer(blue);
  window->SetSize(16, 16);
  window->Render();
  EXPECT_EQ(blueOf(window), 255);
}

TEST(Fonts, AFileAnswersToOurFamily) {
  const FontFile font = findFont();
  if (font.path.empty()) GTEST_SKIP() << "no fonts on this machine";
  EXPECT_NE(font.path.find('/'), std::string::npos);
  EXPECT_FALSE(font.family.empty());
}

}  // namespace
}  // namespace softscope
