// tests/cuda/survey_cases.h: frames whose survey on a device must be the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "comparison_cases.h"
#include "stereo/depth/relief_error.h"
#include "survey_frame.h"

namespace softscope::test {

constexpr double kFocalBaseline = 1400;  // pixels, mm

inline void expectSameDepths(const TissueDepths& found, const TissueDepths& expected) {
  EXPECT_EQ(found.tissue_px, expected.tissue_px);
  EXPECT_EQ(found.measured_px, expected.measured_px);
  EXPECT_EQ(found.precise_px, expected.precise_px);
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  EXPECT_TRUE(same(found.median_mm, expected.median_mm))
      << found.median_mm << ", not " << expected.median_mm;
  EXPECT_TRUE(same(found.median_sigma_mm, expected.median_sigma_mm))
      << found.median_sigma_mm << ", not " << expected.median_sigma_mm;
}

/// Of the frame in use.
inline void expectTheCpusRelief(const DepthMap& depth, const PinholeCamera& camera,
                                FrameSurvey* survey) {
  RectifiedRig rig;
  rig.left = camera;
  rig.baseline_mm = kFocalBaseline / camera.fx_px;
  const Raster<float> found = survey->reliefOf(depth, kFocalBaseline);
  const Raster<float> expected = reliefErrorPx(depth.depth_mm, rig);
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(std::memcmp(found.values.data(), expected.values.data(), 4 * expected.size()), 0);
}

/// Frames in turn, then one where nothing is measured, and one that shows no tissue.
inline void expectTheCpusSurvey(FrameSurvey* survey) {
  for (const ComparisonCase& each : comparisonCases()) {
    SCOPED_TRACE(each.name);
    const ComparisonScene scene(each);
    const Observation frame = scene.observation();
    const PinholeCamera camera = frame.left;
    Mask mask = frame.mask;
    if (mask.empty()) mask = Mask(camera.width_px, camera.height_px, 0);
    DepthMap depth = frame.depth;
    for (int k = 0; k < 4; ++k) {
      if (k == 1) mask.at(camera.width_px / 2, camera.height_px / 2) ^= 1;  // one pixel less
      if (k == 2) depth.depth_mm.values.assign(depth.depth_mm.size(), std::nanf(""));
      if (k == 3) mask.values.assign(mask.size(), 255);
      const Observation masked{depth, frame.normals, frame.colour, mask, camera};
      const Surveyed found = surveyFrame(masked, scene.options().pixels, survey);
      expectSameDepths(found.depths, tissueDepths(depth, mask));
      EXPECT_TRUE(found.states.values == classifyPixels(masked, scene.options().pixels).values);
      survey->use(depth);
      expectTheCpusRelief(depth, camera, survey);
    }
  }
}

}  // namespace softscope::test
