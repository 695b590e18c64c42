// tests/stereo/returned_relief_test.cpp: relief that the last steps of the refinement return.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/not_measured.h"
#include "stereo/kernels/relief_formulas.h"
#include "stereo/refinement/smooth_relief.h"

namespace softscope {
namespace {

TEST(ReturnedRelief, HasNoiseOfTheWindowsResponse) {
  // With x = the squared frequency, a window's response is exp(-x), and noise passes its square.
  double of_planes = 0, of_relief = 0, shared = 0;
  constexpr double kSpacing = 1e-3;
  for (double x = kSpacing / 2; x < 20; x += kSpacing) {
    const double kept = std::exp(-x), relief = kept - kept * kept;
    of_planes += kSpacing * kept * kept;
    of_relief += kSpacing * relief * relief;
    shared += kSpacing * kept * relief;
  }
  EXPECT_NEAR(of_relief / of_planes, RefinementOptions::kReliefNoise, 1e-4);
  EXPECT_NEAR(shared / of_planes, RefinementOptions::kReliefCovariance, 1e-4);
}

TEST(ReturnedRelief, IsKeptAsFarAsItExceedsNoise) {
  const float noise_px2 = 0.01f, relief_noise_px2 = 0.01f / 6;
  EXPECT_EQ(reliefGain(0.0f, 0.0f), 0);
  EXPECT_EQ(reliefGain(relief_noise_px2, noise_px2), 0);
  EXPECT_NEAR(reliefGain(2 * relief_noise_px2, noise_px2), 0.5, 1e-6);
  EXPECT_NEAR(reliefGain(100.0f, noise_px2), 1, 1e-4);
  // Of the whole relief 11/6 of the planes' noise, of none their own; the model's error stays.
  EXPECT_FLOAT_EQ(varianceWithRelief(0.03f, 0.0f, 0.02f), 0.03f);
  EXPECT_FLOAT_EQ(varianceWithRelief(0.03f, 1.0f, 0.02f), 0.02f + 0.01f * 11 / 6);
}

/// Of planes at 10 px, with a relief of 0.1 px in the rows from `first` on; the others are
/// unmatched.
std::vector<float> smoothOf(int first, float response, int row) {
  const int width = 60, height = 44;
  Plane planes(width, height, kNotMeasured<float>), disparity = planes;
  const Plane responses(width, height, response);
  for (int v = first; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      planes.row(v)[u] = 10;
      disparity.row(v)[u] = 10.1f;
    }
  const SmoothRelief smooth(planes, disparity, responses, width, height, {0.25f, 0.5f, 0.25f});
  std::vector<float> relief(width);
  smooth.row(row, width, relief.data());
  return relief;
}

TEST(SmoothRelief, IsWhatTheStepsWouldReturnInTheEnd) {
  EXPECT_FLOAT_EQ(reliefResponse(0.5f), 0.75f);
  for (const int row : {0, 3, 21, 43})  // at borders as inside
    for (const float relief : smoothOf(0, 0.8f, row)) EXPECT_NEAR(relief, 0.125, 1e-5);
  // At most twice what they returned.
  for (const float relief : smoothOf(0, 0.1f, 20)) EXPECT_NEAR(relief, 0.2, 1e-5);
}

TEST(SmoothRelief, CountsMatchedPixelsAlone) {
  for (const float relief : smoothOf(30, 1, 40)) EXPECT_NEAR(relief, 0.1, 1e-5);
  for (const float relief : smoothOf(30, 1, 28)) EXPECT_NEAR(relief, 0.1, 1e-5);
  for (const float relief : smoothOf(44, 1, 20)) EXPECT_EQ(relief, 0);  // nothing is matched
}

}  // namespace
}  // namespace softscope
