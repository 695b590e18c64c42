// tests/cuda/locate_device_test.cpp: view, matching and lift on the GPU give the CPU's bytes.
#include <gtest/gtest.h>

#include "core/error.h"
#include "cuda/device/device_info.h"
#include "cuda/frame/survey.h"
#include "cuda/locate/locate.h"
#include "locate_cases.h"
#include "survey_frame.h"

namespace softscope {
namespace {

void surveyScene(const test::LocateScene& scene, FrameSurvey* survey) {
  const NormalMap normals(scene.camera.width_px, scene.camera.height_px);
  const ColourImage no_colour;
  const Mask no_mask;
  test::surveyFrame({scene.depth, normals, no_colour, no_mask, scene.camera}, {}, survey,
                    scene.live.gray, scene.live.ignore);
  survey->use(scene.depth);
}

TEST(LocateOnDevice, GivesTheCpusLiftedMatchesFrameAfterFrame) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  test::LocateScene scene = test::locateScene();
  cuda::Locator locator(scene.camera, scene.view_options, MatcherOptions(),
                        static_cast<int>(scene.model.size()) + 100);
  const auto frames = std::make_shared<cuda::SharedFrames>();
  const auto survey = cuda::makeFrameSurvey(scene.camera, frames);
  for (int frame = 0; frame < 4; ++frame) {
    const GrayImage seen_gray = frame % 2 == 0 ? GrayImage() : scene.live.gray;
    if (frame == 2) {  // a smaller model, no sigma
      scene.model.positions_mm.resize(scene.model.size() * 3 / 4);
      scene.model.normals.resize(scene.model.size());
      scene.model.colours.resize(scene.model.size());
      scene.model.anchors.resize(scene.model.size());
      scene.depth.sigma_mm = {};
    }
    locator.setModel(scene.model);
    locator.setLive(scene.live, scene.depth);
    locator.setSeenGray(seen_gray);
    locator.timeStages(frame == 3);
    locator.locate(scene.world_from_left);
    const cuda::LocatedMatches found = locator.download();
    EXPECT_GE(found.pixels.size(), found.lifted.size());
    const std::vector<LiftedMatch> expected = test::cpuLifted(scene, seen_gray);
    EXPECT_GT(expected.size(), 200U);
    EXPECT_EQ(test::differingLifted(found.lifted, expected), 0);
    surveyScene(scene, survey.get());
    ASSERT_NE(frames->at_hand.match_gray, nullptr);
    locator.setLive(frames->at_hand);
    locator.locate(scene.world_from_left);
    EXPECT_EQ(test::differingLifted(locator.download().lifted, expected), 0);
  }
  EXPECT_FALSE(locator.stageTimes().empty());
}

TEST(LocateOnDevice, AnotherShapeIsRefused) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const test::LocateScene scene = test::locateScene();
  cuda::Locator locator(scene.camera, {}, MatcherOptions(), 10);
  EXPECT_THROW(locator.setSeenGray(GrayImage(10, 10)), InputError);
  EXPECT_THROW(locator.setModel(scene.model), Error);
}

}  // namespace
}  // namespace softscope
