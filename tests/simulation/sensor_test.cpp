// tests/simulation/sensor_test.cpp: light becomes grey levels by rules that can be checked.
#include "eval/simulation/camera/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/simulation/view/scope_shading.h"

namespace softscope {
namespace {

SensorOptions ideal() {
  SensorOptions options;
  options.exposure = 1;
  options.vignetting = options.blur_px = options.noise = options.shot_noise = 0;
  return options;
}

Raster<Eigen::Vector3f> grey(float light, int width, int height) {
  return {width, height, Eigen::Vector3f::Constant(light)};
}

TEST(Sensor, FollowsTheSrgbCurve) {
  // IEC 61966-2-1: linear 0.2140 is level 0.5, linear 0.0010 is 0.0129.
  EXPECT_EQ(takePicture(grey(0.2140F, 4, 4), ideal(), 0, 1).at(1, 1).green, 127);
  EXPECT_EQ(takePicture(grey(0.0010F, 4, 4), ideal(), 0, 1).at(1, 1).red, 3);
  EXPECT_EQ(takePicture(grey(0, 4, 4), ideal(), 0, 1).at(1, 1).blue, 0);
  EXPECT_EQ(takePicture(grey(100, 4, 4), ideal(), 0, 1).at(1, 1).blue, 255);
}

TEST(Sensor, NoiseHasItsStandardDeviation) {
  SensorOptions options = ideal();
  options.noise = 0.01;
  const ColourImage picture = takePicture(grey(0.2140F, 200, 200), options, 0, 1);
  double sum = 0, squares = 0;
  for (const Rgb8& pixel : picture.values) {
    sum += pixel.red;
    squares += double(pixel.red) * pixel.red;
  }
  const double n = double(picture.size()), mean = sum / n;
  const double deviation = std::sqrt(squares / n - mean * mean);
  // The curve's slope at 0.214 is 0.990 / 1 level of 255: 0.01 is 2.5 grey levels. 40,000 pixels
  // give it to 0.4 %; rounding to whole levels adds 0.7 %.
  EXPECT_NEAR(deviation, 0.01 * 255 * 1.055 / 2.4 * std::pow(0.2140, 1 / 2.4 - 1), 0.05);
  EXPECT_NEAR(mean, 127.5, 0.6);  // half a level by rounding, 0.01 by chance
  EXPECT_NE(picture.values, takePicture(grey(0.2140F, 200, 200), options, 0, 2).values);
}

TEST(Sensor, BlurKeepsLightAndVignettingDarkensCorners) {
  Raster<Eigen::Vector3f> point = grey(0, 21, 21);
  point.at(10, 10) = Eigen::Vector3f::Constant(0.5F);
  SensorOptions options = ideal();
  options.blur_px = 1;
  const ColourImage picture = takePicture(point, options, 0, 1);
  EXPECT_GT(picture.at(11, 10).red, 0);
  EXPECT_EQ(picture.at(11, 10), picture.at(9, 10));
  EXPECT_EQ(picture.at(11, 10), picture.at(10, 11));
  options = ideal();
  options.vignetting = 0.5;
  const ColourImage dark = takePicture(grey(0.4F, 21, 21), options, 0, 1);
  EXPECT_EQ(dark.at(0, 0), takePicture(grey(0.2F, 21, 21), ideal(), 0, 1).at(0, 0));
  EXPECT_EQ(dark.at(10, 10), takePicture(grey(0.4F, 21, 21), ideal(), 0, 1).at(10, 10));
}

TEST(Sensor, ExposureChangesWithItsPeriod) {
  SensorOptions options = ideal();
  options.exposure_change = 0.2;
  options.exposure_period_s = 2;
  EXPECT_NEAR(options.exposureAt(0.5), 1.2, 1e-12);
  EXPECT_NEAR(options.exposureAt(1.5), 0.8, 1e-12);
}

TEST(Sensor, RefusesImpossibleSettings) {
  SensorOptions options;
  options.noise = -1;
  EXPECT_THROW(options.validate(), OptionError);
  options = {};
  options.vignetting = 1.5;
  EXPECT_THROW(options.validate(), OptionError);
}

TEST(ScopeLight, FallsOffWithTheSquareOfTheDistance) {
  LightOptions options;
  options.x_mm = options.y_mm = options.z_mm = options.beam = 0;
  const ScopeLight light(options, /*baseline_mm=*/0, /*reference_mm=*/50);
  LitPoint point{{0, 0, 50}, {0, 0, -1}, {0.4F, 0.2F, 0.1F}, 0};
  const Eigen::Vector3f eye(0, 0, 0);
  // White that faces the light at the reference distance sends back 1; 1e-6: rounding of float.
  EXPECT_LT((light.shade(point, eye) - point.albedo).norm(), 1e-6);
  point.position_mm.z() = 100;
  EXPECT_LT((light.shade(point, eye) - 0.25F * point.albedo).norm(), 1e-6);
}

TEST(ScopeLight, HighlightsDependOnTheEyeAndDullTissueDoesNot) {
  const ScopeLight light({}, 5, 50);
  const Eigen::Vector3f normal =
      Eigen::Vector3f(0.025F, -0.03F, -1).normalized();  // to the left eye
  LitPoint point{{0, 0, 50}, normal, {0.4F, 0.2F, 0.1F}, 1};
  EXPECT_GT((light.shade(point, {0, 0, 0}) - light.shade(point, {5, 0, 0})).norm(), 0.01);
  point.wetness = 0;
  EXPECT_EQ(light.shade(point, {0, 0, 0}), light.shade(point, {5, 0, 0}));
}

}  // namespace
}  // namespace softscope
