// tests/pipeline/model_sigma_test.cpp: predicted errors of model points over surfaces whose relief
// is known.
#include "pipeline/model/model_sigma.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope::model_sigma {
namespace {

constexpr double kFocalPx = 400, kBaselineMm = 5, kDepthMm = 80;
constexpr double kScale = kFocalPx * kBaselineMm;          // disparity times depth
constexpr double kMmPerPx = kDepthMm * kDepthMm / kScale;  // of disparity, at kDepthMm
const PinholeCamera kLeft{320, 240, kFocalPx, kFocalPx, 159.5, 119.5};

RectifiedRig rig() {
  RectifiedRig rig;
  rig.left = kLeft;
  rig.baseline_mm = kBaselineMm;
  return rig;
}

/// Disparity around that of kDepthMm, px, at u and v from the image's middle.
template <class Disparity>
DepthMap depthOf(const Disparity& away_px) {
  DepthMap depth{Raster<float>(320, 240), Raster<float>(320, 240, 0.1f)};
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      depth.depth_mm.at(u, v) =
          static_cast<float>(kScale / (kScale / kDepthMm + away_px(u - 160, v - 120)));
  return depth;
}

/// One point of that weight in the middle of the image, that faces the camera.
PointModel pointInTheMiddle(float weight) {
  PointModel model;
  model.add({0, 0, kDepthMm}, {0, 0, -1}, {}, weight);
  return model;
}

void observe(const DepthMap& depth, const WarpGraph& graph, LastingErrors* errors) {
  errors->observe(levelledRelief(depthOfSquares(depth.depth_mm), rig()), {depth, {}, {}, {}, kLeft},
                  graph, {});
}

LastingErrors seen(const DepthMap& depth, const WarpGraph& graph = {}) {
  LastingErrors errors;
  observe(depth, graph, &errors);
  return errors;
}

double sigmaOver(const DepthMap& depth, float weight) {
  return modelSigmas(pointInTheMiddle(weight), {}, seen(depth)).at(0);
}

TEST(ModelSigma, IsTheWeightsAloneOverAPlane) {
  const DepthMap plane = depthOf([](int u, int v) { return 0.02 * u - 0.01 * v; });
  EXPECT_NEAR(sigmaOver(plane, 1), 0.1, 1e-3);  // the reference
  EXPECT_NEAR(sigmaOver(plane, 10), 0.1 / std::sqrt(10.0), 1e-3);
}

TEST(ModelSigma, TakesInFoldsThatAreFinerThanTwoWindows) {
  constexpr double kAmplitudePx = 0.5, kLengthPx = 14;
  const DepthMap folds =
      depthOf([](int u, int) { return kAmplitudePx * std::sin(2 * M_PI * u / kLengthPx); });
  // Two wavelengths fit into the windows, whose mean is then flat: the fold itself is left.
  const double fold_mm = kAmplitudePx / std::sqrt(2.0) * kMmPerPx;
  EXPECT_NEAR(sigmaOver(folds, 10), std::hypot(fold_mm, 0.1 / std::sqrt(10.0)), 0.15 * fold_mm);
}

TEST(ModelSigma, TakesInWhatOneWindowTakesFromAnEvenBend) {
  constexpr double kBend = 2e-3;  // px of disparity a pixel^2
  const DepthMap bent = depthOf([](int u, int) { return kBend * u * u; });
  const double mean_sq_px2 = 13.0 * 13 / 12;  // of places in one window, along a row
  const double bias_mm = kBend * mean_sq_px2 * kMmPerPx;
  const double sigma_mm = std::sqrt(std::pow(sigmaOver(bent, 10), 2) - 0.001);
  EXPECT_NEAR(sigma_mm, bias_mm, 0.25 * bias_mm);  // coarse pixels cover 28 px for 25
}

TEST(ModelSigma, IsUnknownWhereNothingWasSeen) {
  PointModel model = pointInTheMiddle(10);
  model.positions_mm[0].z() = 70;  // before the surface
  const LastingErrors errors = seen(depthOf([](int, int) { return 0; }));
  EXPECT_TRUE(std::isnan(modelSigmas(model, {}, errors).at(0)));
  model.positions_mm[0] = {500, 0, kDepthMm};  // outside of the image
  EXPECT_TRUE(std::isnan(modelSigmas(model, {}, errors).at(0)));
}

TEST(ModelSigma, GrowsOutOfSightAsTheTissueInSightMoves) {
  constexpr double kStepMm = 0.3;
  WarpGraph graph;
  graph.positions_mm = {{0, 0, kDepthMm}, {10, 0, kDepthMm}};
  graph.stencils = {{1, 1, 1, 1}};
  PointModel model = pointInTheMiddle(10);
  model.positions_mm[0].x() = 10;
  model.bindings[0] = {0, {1, 0, 0, 0}};
  const DepthMap plane = depthOf([](int, int) { return 0; });
  LastingErrors errors = seen(plane, graph);
  EXPECT_NEAR(modelSigmas(model, graph, errors).at(0), 0.1 / std::sqrt(10.0), 1e-3);

  DepthMap half = plane;  // the right half of the image shows nothing
  for (int v = 0; v < 240; ++v)
    for (int u = 180; u < 320; ++u) half.depth_mm.at(u, v) = std::nanf("");
  for (int frame = 1; frame <= 4; ++frame) {
    graph.positions_mm[0].x() += kStepMm;
    observe(half, graph, &errors);
    const double grown_mm2 = frame * kStepMm * kStepMm / 3;  // one direction of three
    EXPECT_NEAR(modelSigmas(model, graph, errors).at(0), std::sqrt(0.001 + grown_mm2), 2e-3);
  }
  observe(plane, graph, &errors);
  EXPECT_NEAR(modelSigmas(model, graph, errors).at(0), 0.1 / std::sqrt(10.0), 1e-3) << "seen again";
}

TEST(ModelSigma, IsNotGivenWhereDepthHasNone) {
  DepthMap depth = depthOf([](int, int) { return 0; });
  depth.sigma_mm = {};
  EXPECT_TRUE(modelSigmas(pointInTheMiddle(10), {}, seen(depth)).empty());
  EXPECT_TRUE(modelSigmas(pointInTheMiddle(10), {}, {}).empty()) << "no frame yet";
}

}  // namespace
}  // namespace softscope::model_sigma
