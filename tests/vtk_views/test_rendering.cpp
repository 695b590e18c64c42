// tests/vtk_views/test_rendering.cpp: pictures without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>

#include "vtk_views/drawing/fonts.h"
#include "vtk_views/scenes/egl_display.h"
#include "vtk_views/scenes/offscreen_window.h"
#include "vtk_views/scenes/render_check.h"

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

TEST(EglDevices, SoftwareIsTriedLast) {
  const std::string software = "EGL_MESA_device_software EGL_EXT_device_drm_render_node";
  const std::string mesa_gpu = "EGL_EXT_device_drm", nvidia = "EGL_NV_device_cuda";
  EXPECT_THAT(deviceOrder({software, mesa_gpu, nvidia}), testing::ElementsAre(1, 2, 0));
  EXPECT_THAT(deviceOrder({nvidia, software}), testing::ElementsAre(0, 1));
  EXPECT_THAT(deviceOrder({software}), testing::ElementsAre(0));
  EXPECT_TRUE(deviceOrder({}).empty());
}

TEST(Fonts, AFileAnswersToOurFamily) {
  const FontFile font = findFont(figureFont());
  if (font.path.empty()) GTEST_SKIP() << "no fonts on this machine";
  EXPECT_NE(font.path.find('/'), std::string::npos);
  EXPECT_FALSE(font.family.empty());
}

}  // namespace
}  // namespace softscope
