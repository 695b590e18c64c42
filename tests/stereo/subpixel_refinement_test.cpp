// tests/stereo/subpixel_refinement_test.cpp: hundredths of a pixel, and honest about the error.
#include "stereo/refinement/subpixel_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "stereo/kernels/filter_formulas.h"
#include "stereo/kernels/light_formulas.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/refinement/refinement_window.h"
#include "support/scene.h"

namespace softscope {
namespace {

/// What a perfect whole-pixel matcher would hand over: NaN where the right picture ends.
Raster<float> rounded(const Raster<float>& truth) {
  Raster<float> whole = truth;
  for (int v = 0; v < truth.height_px; ++v)
    for (int u = 0; u < truth.width_px; ++u) {
      float& d = whole.at(u, v);
      d = static_cast<float>(u) < d ? std::numeric_limits<float>::quiet_NaN() : std::round(d);
    }
  return whole;
}

struct Errors {
  double median_px, bias_px, median_of_sigmas;
  std::size_t measured;
};

Errors errorsOf(const DisparityMap& map, const Raster<float>& truth) {
  std::vector<double> absolute, ratio;
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double e = map.disparity_px.values[i] - truth.values[i];
    if (std::isnan(e)) continue;
    sum += e;
    absolute.push_back(std::abs(e));
    ratio.push_back(std::abs(e) / map.sigma_px.values[i]);
  }
  const auto median = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
    return v[v.size() / 2];
  };
  return {median(absolute), sum / absolute.size(), median(ratio), absolute.size()};
}

TEST(SubpixelRefinement, FindsAPlaneToATwentiethPixel) {
  for (const double distance_mm : {45.0, 51.3, 58.7}) {
    const auto scene = test::makeScene(test::endoscope(), test::plane(distance_mm), 0);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    EXPECT_LT(e.median_px, 0.05);  // whole pixels are up to half a pixel off, all to one side
    EXPECT_LT(std::abs(e.bias_px), 0.08);  // patches without texture stay where they began
  }
}

TEST(SubpixelRefinement, FollowsSlantAndCurvature) {
  for (const auto& surface : {test::plane(55, 0.6, 0.3), test::sphere({0, 0, 80}, 30)}) {
    const auto scene = test::makeScene(test::endoscope(), surface, 1.0);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    EXPECT_LT(e.median_px, 0.05);  // with sensor noise of one grey level
  }
}

/// Ridges along x, one every `length_mm`, about a plane at `distance_mm`.
test::Surface ridges(double distance_mm, double height_mm, double length_mm) {
  return [=](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    double s = distance_mm / direction.z();
    for (int i = 0; i < 50; ++i) {
      const double y = origin.y() + s * direction.y();
      const double z = distance_mm + height_mm * std::sin(2 * M_PI * y / length_mm);
      s = (z - origin.z()) / direction.z();
    }
    return s;
  };
}

/// Share of the relief that is measured: slope of the regression of measured on true disparity.
double shareOfRelief(const DisparityMap& map, const Raster<float>& truth) {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t = truth.values[i], d = map.disparity_px.values[i];
    if (std::isnan(d)) continue;
    count += 1;
    x += t;
    y += d;
    xx += t * t;
    xy += t * d;
  }
  return (xy - x * y / count) / (xx - x * x / count);
}

TEST(SubpixelRefinement, ReturnsReliefThatWindowsLevelOut) {
  // Ridges 20 px apart, with sensor noise of one grey level: planes alone keep 0.56 of them.
  const auto scene = test::makeScene(test::endoscope(), ridges(55, 0.5, 3.93), 1.0);
  const auto map = refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {});
  EXPECT_GT(shareOfRelief(map, scene.disparity_px), 0.75);
  EXPECT_LT(shareOfRelief(map, scene.disparity_px), 1);
}

TEST(SubpixelRefinement, ReturnsAnErrorThatManyWindowsShare) {
  // Matched half a pixel too far everywhere; without smooth relief 0.043 px of it are left.
  const auto scene = test::makeScene(test::endoscope(), test::plane(55), 3);
  Raster<float> off = scene.disparity_px;
  for (float& d : off.values) d -= 0.5f;
  const auto e =
      errorsOf(refineDisparity(scene.left, scene.right, rounded(off), {}), scene.disparity_px);
  EXPECT_LT(std::abs(e.bias_px), 0.032);
}

TEST(SubpixelRefinement, PredictsItsError) {
  for (const double noise_gray : {1.0, 3.0, 6.0}) {
    const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), noise_gray);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    // For a Gaussian, half of of_all_steps errors lie within 0.67 standard errors. A factor of two
    // either way is what the prediction promises.
    EXPECT_GT(e.median_of_sigmas, 0.33) << noise_gray;
    EXPECT_LT(e.median_of_sigmas, 1.35) << noise_gray;
  }
}

TEST(SubpixelRefinement, KeepsTwoSurfacesApart) {
  const auto scene = test::makeScene(
      test::endoscope(), test::nearest(test::sphere({0, 0, 52}, 12), test::plane(70)), 1.0);
  const auto map = refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {});
  int between = 0, measured = 0;
  for (std::size_t i = 0; i < map.disparity_px.size(); ++i) {
    const float e = std::abs(map.disparity_px.values[i] - scene.disparity_px.values[i]);
    if (std::isnan(e)) continue;
    ++measured;
    between += e > 1.0f;
  }
  EXPECT_GT(measured, 60000);
  // The step is 13 px high and its rim about 700 px long, in part occluded: a window that mixed
  // both sides would spoil some 8000 pixels.
  EXPECT_LT(between, 800);
}

/// Weak tissue: a tenth of the contrast, under light that falls off to the side, with noise.
test::Scene weakTissue(double gain_right = 1, double offset_right = 0) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.3, 0.1), 0);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2);
  const auto relight = [&](GrayImage& image, const auto& disparityAt, double gain, double offset) {
    for (int v = 0; v < image.height_px; ++v)
      for (int u = 0; u < image.width_px; ++u) {
        // Light belongs to the tissue: to the column where the left camera sees it.
        const double at = u + disparityAt(u, v);
        const double light = 60 + 0.25 * at + 20 * std::sin(at / 25);
        const double gray = gain * (light + 0.1 * (image.at(u, v) - 90)) + offset + noise(random);
        image.at(u, v) = static_cast<std::uint8_t>(std::clamp(std::lround(gray), 0L, 255L));
      }
  };
  relight(
      scene.left, [](int, int) { return 0.0; }, 1, 0);
  // The disparity changes by a hundredth of the column: one step inverts it well enough.
  const auto& disparity = scene.disparity_px;
  const auto fromRight = [&](int u, int v) {
    const int first = std::min(u + static_cast<int>(disparity.at(160, v)), 319);
    const int second = std::min(u + static_cast<int>(std::lround(disparity.at(first, v))), 319);
    return static_cast<double>(disparity.at(second, v));
  };
  relight(scene.right, fromRight, gain_right, offset_right);
  return scene;
}

TEST(SubpixelRefinement, ReadsTheLightOfWeakTissue) {
  const auto scene = weakTissue();
  const auto e = errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                          scene.disparity_px);
  EXPECT_LT(e.median_px, 0.1);  // 0.111 by the fast part of the brightness alone
}

TEST(SubpixelRefinement, CorrectsGainAndOffsetBetweenTheCameras) {
  const auto scene = weakTissue(1.1, -6);
  const auto e = errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                          scene.disparity_px);
  EXPECT_LT(e.median_px, 0.1);
}

/// A broad highlight around (centre_u_px, 120).
void addHighlight(double centre_u_px, double light_gray, double sigma_px, GrayImage* image) {
  for (int v = 0; v < image->height_px; ++v)
    for (int u = 0; u < image->width_px; ++u) {
      const double apart_px = std::hypot(u - centre_u_px, v - 120.0);
      const double light = light_gray * std::exp(-apart_px * apart_px / (2 * sigma_px * sigma_px));
      image->at(u, v) = static_cast<std::uint8_t>(std::min(255.0, image->at(u, v) + light));
    }
}

TEST(SubpixelRefinement, TakesNoHighlightForTissue) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 1.0);
  Raster<float> truth = scene.disparity_px;
  // At the same position in both images: it is at infinity.
  for (GrayImage* image : {&scene.left, &scene.right}) addHighlight(170, 70, 15, image);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      if (std::abs(u - 170) > 40 || std::abs(v - 120) > 40)
        truth.at(u, v) = std::numeric_limits<float>::quiet_NaN();
  const auto e =
      errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}), truth);
  EXPECT_LT(e.median_px, 0.13);  // 0.23 if all of the slow part counted
}

/// The lobe of a highlight whose core is white, at the disparity of what it mirrors.
TEST(SubpixelRefinement, TrustsTheTextureAroundAWhiteHighlight) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 1.0);
  Raster<float> truth = scene.disparity_px;
  const double mirrored_px = truth.at(170, 120) - 1;  // a little behind the tissue
  addHighlight(170, 250, 14, &scene.left);
  addHighlight(170 - mirrored_px, 250, 14, &scene.right);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double apart_px = std::hypot(u - 170.0, v - 120.0);
      if (apart_px < 16 || apart_px > 28) truth.at(u, v) = std::numeric_limits<float>::quiet_NaN();
    }
  const auto e =
      errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}), truth);
  EXPECT_LT(e.median_px, 0.4);  // 0.49 if all of the slow part counted
}

TEST(DiffuseShare, IsAllOfBlackAndNothingOfWhite) {
  EXPECT_FLOAT_EQ(diffuseShare(0.0f, 0.0f), 1);
  EXPECT_FLOAT_EQ(diffuseShare(127.5f, 10.0f), 0.875);
  EXPECT_FLOAT_EQ(diffuseShare(10.0f, 127.5f), 0.875);  // the brighter of both
  EXPECT_FLOAT_EQ(diffuseShare(255.0f, 0.0f), 0);
  EXPECT_FLOAT_EQ(diffuseShare(0.0f, 260.0f), 0);  // interpolation may exceed white
}

TEST(LightFit, FindsOffsetSlopesAndGain) {
  const int width = 160, height = 120;
  const LightDifference truth{3, -2, 1.5, 4};
  Raster<float> left(width, height), right(width, height), disparity(width, height, 5.0f);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      left.at(u, v) = 100 + 30 * std::sin(0.1f * static_cast<float>(u + 2 * v));
  for (int v = 0; v < height; ++v) {
    const LightRow row = lightOfRow(truth, v, width, height);
    for (int u = 0; u < width - 5; ++u)
      right.at(u, v) =
          left.at(u + 5, v) + lightAt(row, static_cast<float>(u + 5), left.at(u + 5, v));
  }
  for (int u = 40; u < 80; ++u)  // a highlight in one of the images
    for (int v = 30; v < 60; ++v) right.at(u, v) += 60;
  LightDifference found;
  for (int round = 0; round < 8; ++round) {
    LightSums sums;
    for (int i = 0; i < LightFit::samplesAlong(height); ++i)
      for (int part = 0; part < LightFit::kParts; ++part) {
        const int v = LightFit::place(i);
        sums.add(lightSumsOfPart(left.row(v), right.row(v), disparity.row(v), v, part, width,
                                 height, found, LightFit::tolerance(0, round)));
      }
    found = solveLight(sums);
  }
  EXPECT_NEAR(found.at_centre, truth.at_centre, 0.1);
  EXPECT_NEAR(found.across, truth.across, 0.1);
  EXPECT_NEAR(found.down, truth.down, 0.1);
  EXPECT_NEAR(found.gain, truth.gain, 0.1);
}

TEST(LightFit, IsZeroWithoutPixels) {
  const LightDifference light = solveLight(LightSums());
  EXPECT_EQ(light.at_centre, 0);
  EXPECT_EQ(light.gain, 0);
}

TEST(SubpixelRefinement, LeavesUnmatchedPixelsUnmatched) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55), 0);
  Raster<float> initial = rounded(scene.disparity_px);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int v = 50; v < 60; ++v)
    for (int u = 0; u < 320; ++u) initial.at(u, v) = nan;
  const auto map = refineDisparity(scene.left, scene.right, initial, {});
  for (int v = 50; v < 60; ++v)
    for (int u = 0; u < 320; ++u) {
      EXPECT_TRUE(std::isnan(map.disparity_px.at(u, v)));
      EXPECT_TRUE(std::isnan(map.sigma_px.at(u, v)));
    }
}

TEST(SubpixelRefinement, IsUnsureWhereThereIsNoTexture) {
  const GrayImage flat(96, 96, 120);
  const auto map = refineDisparity(flat, flat, Raster<float>(96, 96, 10.0f), {});
  for (const float d : map.disparity_px.values) EXPECT_TRUE(std::isnan(d));
}

constexpr std::uint8_t kFlatGray = 40;  // the texture has 90 on average

/// Columns of both images without texture, where the left one sees [begin, end).
void flatten(int begin, int end, test::Scene* scene) {
  for (int v = 0; v < scene->left.height_px; ++v)
    for (int u = begin; u < end; ++u) {
      scene->left.at(u, v) = kFlatGray;
      const int right = u - static_cast<int>(std::lround(scene->disparity_px.at(u, v)));
      if (right >= 0) scene->right.at(right, v) = kFlatGray;
    }
}

TEST(SubpixelRefinement, DropsTheRimBeyondItsEvidenceAtHalfTheSize) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 1.0);
  constexpr int kRim = 160, kMatchedFrom = 148;
  flatten(0, kRim, &scene);
  Raster<float> initial = rounded(scene.disparity_px);
  for (int v = 0; v < initial.height_px; ++v)
    std::fill_n(initial.row(v), kMatchedFrom, std::numeric_limits<float>::quiet_NaN());
  RefinementOptions options;
  options.halvings = 1;
  const DisparityMap all = refineEveryPixel(scene.left, scene.right, initial, options);
  const DisparityMap kept = refineDisparity(scene.left, scene.right, initial, options);

  int beyond = 0, beyond_kept = 0, inside = 0, inside_kept = 0;
  for (int v = 0; v < initial.height_px; ++v)
    for (int u = kMatchedFrom; u < initial.width_px - 10; ++u) {
      const bool measured = !std::isnan(all.disparity_px.at(u, v));
      const bool is_kept = !std::isnan(kept.disparity_px.at(u, v));
      if (is_kept) {
        EXPECT_EQ(kept.disparity_px.at(u, v), all.disparity_px.at(u, v));
      }
      EXPECT_EQ(is_kept, !std::isnan(kept.sigma_px.at(u, v)));
      (u < kRim - 1 ? beyond : inside) += measured;
      (u < kRim - 1 ? beyond_kept : inside_kept) += is_kept;
    }
  EXPECT_GT(beyond, 4 * initial.height_px);  // by the texture of the rim alone
  EXPECT_LT(beyond_kept, beyond / 7);
  EXPECT_GT(inside_kept, 0.95 * inside);
}

TEST(SubpixelRefinement, KeepsWhatLiesBetweenEvidence) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 1.0);
  flatten(160, 166, &scene);
  RefinementOptions options;
  options.halvings = 1;
  const DisparityMap map =
      refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), options);
  for (int v = 20; v < map.disparity_px.height_px - 20; ++v)
    for (int u = 155; u < 171; ++u) EXPECT_FALSE(std::isnan(map.disparity_px.at(u, v))) << u;
}

TEST(RimFromEvidence, IsTheMeanOfHalfAWindow) {
  const RefinementOptions options;
  double sum = 0, moment = 0;
  for (int x = 0; x <= options.radius_px; ++x)
    for (int y = -options.radius_px; y <= options.radius_px; ++y) {
      const double w = std::exp(-0.5 * (x * x + y * y) / std::pow(options.windowSigmaPx(), 2));
      sum += w;
      moment += w * x;
    }
  EXPECT_NEAR(rimFromEvidencePx(options), moment / sum, 1e-5);
}

TEST(BeyondEvidence, IsAnUnmeasuredSideOfARim) {
  const auto everywhere = [](int, int) { return true; };
  const auto right = [](int x, int) { return x > -4; };
  const auto rim = [](int x, int) { return x > 2 ? 100.0f : 85.0f; };
  const auto isBeyond = [&](float x, float y, int reach, const auto& measured, const auto& gray) {
    return isBeyondEvidence(x, y, 2.0f, reach, measured, gray);
  };
  EXPECT_TRUE(isBeyond(3, 0, 6, right, rim));
  EXPECT_TRUE(isBeyond(3, -3, 6, right, rim));       // obliquely
  EXPECT_TRUE(isBeyond(1e4f, 0, 6, right, rim));     // not looked for outside of the window
  EXPECT_FALSE(isBeyond(3, 0, 6, everywhere, rim));  // between evidence and measured pixels
  EXPECT_FALSE(isBeyond(3, 0, 3, right, rim));       // measured as far as asked
  EXPECT_FALSE(isBeyond(1.9f, 0, 6, right, rim));    // evidence around it
  EXPECT_FALSE(isBeyond(-3, 0, 6, right, rim));      // the other side is measured
  EXPECT_FALSE(isBeyond(0.5f, -3, 6, right, rim));   // upwards
  EXPECT_FALSE(isBeyond(3, 0, 6, right, [](int, int) { return 90.0f; }));  // texture, no rim
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(isBeyond(nan, nan, 6, right, rim));
}

}  // namespace
}  // namespace softscope
