// tests/pipeline/material_points_test.cpp: points go where their tissue goes.
#include "pipeline/tracks/material_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "deform/graph/graph_builder.h"

namespace softscope {
namespace {

/// A plane at 50 mm, 0.2 mm between points.
PointModel flatModel(float shift_mm = 0) {
  PointModel model;
  for (int v = -40; v <= 40; ++v)
    for (int u = -40; u <= 40; ++u)
      model.add({0.2f * u, 0.2f * v, 50 + shift_mm}, {0, 0, -1}, {100, 50, 50}, 5);
  return model;
}

CpuSurfaceSearch on_cpu;

const PinholeCamera kLeft{100, 80, 100, 100, 50, 40};

LookSearcher looksIn(const GrayImage& image) {
  return [picture = LookPicture(image, Mask())](const std::vector<SoughtLook>& sought) {
    return findLooks(sought, picture);
  };
}

/// A point on a depth without relief, bound to the model.
MaterialPoints boundTo(const PointModel& model, float depth_mm = 50,
                       const Eigen::Vector2d& pixel = {50, 40}) {
  MaterialPoints tracked;
  tracked.add(0, pixel, kLeft, Raster<float>(100, 80, depth_mm), Eigen::Isometry3d::Identity());
  tracked.anchor(model, &on_cpu);
  return tracked;
}

TEST(MaterialPoints, BeginWhereTheirRayMeetsTheDepth) {
  MaterialPoints tracked;
  tracked.add(3, {55.5, 40}, kLeft, Raster<float>(100, 80, 50.0f), Eigen::Isometry3d::Identity());
  ASSERT_EQ(tracked.points.size(), 1u);
  EXPECT_EQ(tracked.points[0].id, 3);
  EXPECT_LT((tracked.points[0].position_mm - Eigen::Vector3d(2.75, 0, 50)).norm(), 1e-5);
}

TEST(MaterialPoints, TakeDepthFromNearbyOrStayUnknown) {
  Raster<float> depth_mm(100, 80, std::numeric_limits<float>::quiet_NaN());
  for (int v = 37; v < 44; ++v)
    for (int u = 54; u < 57; ++u) depth_mm.at(u, v) = 40;
  depth_mm.at(14, 40) = 40;  // alone: a mismatch
  MaterialPoints tracked;
  tracked.add(0, {50, 40}, kLeft, depth_mm, Eigen::Isometry3d::Identity());
  tracked.add(1, {10, 40}, kLeft, depth_mm, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(tracked.points[0].position_mm.z(), 40, 1e-6);
  EXPECT_FALSE(tracked.points[1].position_mm.allFinite());
  PointModel model = flatModel();
  tracked.anchor(model, &on_cpu);  // and nothing that follows minds
  tracked.settle(model, Eigen::Vector3d::Zero(), 1, &on_cpu);
  EXPECT_EQ(tracked.points[1].model_point, -1);
}

// Half of the image is an instrument. The tissue next to it is slanted: its nearest depth is wrong.
TEST(MaterialPoints, BeginOnTheSurfaceThatGoesOnBesideAnInstrument) {
  const PinholeCamera left{640, 480, 500, 500, 320, 240};
  Raster<float> depth_mm(640, 480, std::numeric_limits<float>::quiet_NaN());
  const auto depthAt = [](double u) { return 1 / (0.02 - 1e-5 * (u - 300)); };
  for (int v = 0; v < 480; ++v)
    for (int u = 300; u < 640; ++u) depth_mm.at(u, v) = static_cast<float>(depthAt(u));
  MaterialPoints tracked;
  tracked.add(0, {292, 240}, left, depth_mm, Eigen::Isometry3d::Identity());
  tracked.add(1, {270, 240}, left, depth_mm, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(tracked.points[0].position_mm.z(), depthAt(292), 1e-3);
  EXPECT_FALSE(tracked.points[1].position_mm.allFinite()) << "too far from any depth";
}

TEST(MaterialPoints, FollowTheWarp) {
  PointModel model = flatModel();
  WarpGraph graph;
  growGraph(GraphOptions(), &model, &graph);
  MaterialPoints tracked = boundTo(model, 50.0f, {51, 41});
  for (NodeTransform& transform : graph.transforms) transform.translation_mm = {1, 2, -3};
  tracked.warp(graph, model, GraphOptions().node_spacing_mm);
  EXPECT_LT((tracked.points[0].position_mm - Eigen::Vector3d(1.5, 2.5, 47)).norm(), 1e-5);
}

// A point where the model has not been measured yet is carried by nodes 50 mm away, which turn.
TEST(MaterialPoints, AreNotThrownByNodesFarAway) {
  PointModel model = flatModel();
  WarpGraph graph;
  growGraph(GraphOptions(), &model, &graph);
  MaterialPoints tracked = boundTo(model, 100.0f);
  const double spacing_mm = GraphOptions().node_spacing_mm;
  const Eigen::Vector3d before_mm = tracked.points[0].position_mm;
  for (NodeTransform& transform : graph.transforms) {
    transform.linear = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
    transform.translation_mm = {0, 0, 1};
  }
  tracked.warp(graph, model, spacing_mm);
  EXPECT_LT((tracked.points[0].position_mm - before_mm - Eigen::Vector3d::UnitZ()).norm(), 0.1);
}

// Where the model grew over the point later, its nodes carry the point.
TEST(MaterialPoints, AreBoundToNearerTissueOnceItIsMeasured) {
  const PointModel model = flatModel(-20.0f);
  MaterialPoints tracked = boundTo(model);
  PointModel grown = model;
  grown.positions_mm.emplace_back(0.0f, 0.0f, 50.1f);
  IndexMap map;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(model.size()); ++i)
    map.new_of_old.push_back(i);
  tracked.renumber(map, grown, GraphOptions().node_spacing_mm, &on_cpu);
  EXPECT_EQ(tracked.points[0].model_point, static_cast<std::int32_t>(model.size()));
}

/// As in `frames` frames without motion.
void settleFor(int frames, MaterialPoints* tracked, const PointModel& model,
               const Eigen::Vector3d& scope_mm, double limit_scale) {
  for (int k = 0; k < frames; ++k) tracked->settle(model, scope_mm, limit_scale, &on_cpu);
}

// A surface of two layers would otherwise throw the point from one to the other.
TEST(MaterialPoints, ReachASurfaceThatJumpedInSeveralFrames) {
  MaterialPoints tracked = boundTo(flatModel());
  settleFor(1, &tracked, flatModel(0.4f), Eigen::Vector3d::Zero(), 1);
  EXPECT_GT(tracked.points[0].position_mm.z(), 50.1);
  EXPECT_LT(tracked.points[0].position_mm.z(), 50.2);
  settleFor(7, &tracked, flatModel(0.4f), Eigen::Vector3d::Zero(), 1);
  EXPECT_NEAR(tracked.points[0].position_mm.z(), 50.4, 0.04);
}

// Fusion moved the surface by 0.2 mm; 3 mm are another surface.
TEST(MaterialPoints, LieOnTheModelsSurface) {
  for (const auto& [shift_mm, expected_mm] : {std::pair(0.2f, 50.2), std::pair(3.0f, 50.0)}) {
    MaterialPoints tracked = boundTo(flatModel());
    settleFor(40, &tracked, flatModel(shift_mm), Eigen::Vector3d::Zero(), 1);
    EXPECT_NEAR(tracked.points[0].position_mm.z(), expected_mm, 1e-5);
    EXPECT_NEAR(tracked.points[0].position_mm.x(), 0, 1e-5) << "slid along the surface";
  }
}

// Where a pixel of disparity is worth three times as much, so are the errors of depth.
TEST(MaterialPoints, FollowASurfaceFartherAwayByMore) {
  MaterialPoints tracked = boundTo(flatModel());
  settleFor(40, &tracked, flatModel(0.6f), Eigen::Vector3d::Zero(), 1);
  EXPECT_NEAR(tracked.points[0].position_mm.z(), 50, 1e-5);
  settleFor(40, &tracked, flatModel(0.6f), Eigen::Vector3d::Zero(), 3);
  EXPECT_NEAR(tracked.points[0].position_mm.z(), 50.6, 1e-5);
}

// Fusion moves the points of the model along their rays; along the normal
// the point would be 0.02 mm from its tissue, and more in each frame.
TEST(MaterialPoints, StayOnTheirRay) {
  MaterialPoints tracked = boundTo(flatModel(), 50.0f, {60, 40});
  const Eigen::Vector3d before_mm = tracked.points[0].position_mm;
  settleFor(40, &tracked, flatModel(0.2f), Eigen::Vector3d::Zero(), 1);
  EXPECT_LT((tracked.points[0].position_mm - 1.004 * before_mm).norm(), 1e-5);
}

// A ray along the surface meets it far away: there the normal is all there is.
TEST(MaterialPoints, DoNotSlideAlongAGrazingRay) {
  MaterialPoints tracked = boundTo(flatModel());
  settleFor(40, &tracked, flatModel(0.2f), Eigen::Vector3d(-50, 0, 45), 1);
  EXPECT_LT((tracked.points[0].position_mm - Eigen::Vector3d(0, 0, 50.2)).norm(), 1e-5);
}

constexpr double kNodeSpacingMm = 4;

bool everywhere(const Eigen::Vector3d&) { return true; }

/// Waves, 10 to 13 px long.
GrayImage texture() {
  GrayImage image(100, 80);
  for (int v = 0; v < 80; ++v)
    for (int u = 0; u < 100; ++u)
      image.at(u, v) = static_cast<std::uint8_t>(
          std::lround(120 + 40 * std::sin(0.6 * u) + 40 * std::cos(0.5 * v + 0.1 * u)));
  return image;
}

// The warp has carried the point two pixels off; the texture stayed.
TEST(MaterialPoints, GoToWhereTheImageShowsTheirFirstLook) {
  const auto still = Eigen::Isometry3d::Identity();
  MaterialPoints tracked = boundTo(flatModel());
  tracked.look({texture(), Mask()}, flatModel(), kLeft, still, {});
  // A pixel at 50 mm is half a millimetre wide.
  EXPECT_LT((tracked.points[0].pixels_mm.col(0) - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((tracked.points[0].pixels_mm.col(1) - Eigen::Vector3d(0, 0.5, 0)).norm(), 1e-9);
  const Eigen::Vector3d warped(1, 0, 50);
  tracked.points[0].position_mm = warped;
  tracked.align(looksIn(GrayImage(100, 80, 120)), kLeft, still, kNodeSpacingMm, everywhere);
  EXPECT_EQ(tracked.points[0].position_mm, warped) << "nothing to be seen";
  MaterialPoints there = tracked;
  there.align(looksIn(texture()), kLeft, still, kNodeSpacingMm, everywhere);
  EXPECT_LT((there.points[0].position_mm - Eigen::Vector3d(0, 0, 50)).norm(), 0.03);
}

/// Points of a flat wall, `step_px` apart, with their first looks.
MaterialPoints lookedAt(int columns, int rows, const Eigen::Vector2d& step_px) {
  const auto still = Eigen::Isometry3d::Identity();
  MaterialPoints tracked;
  for (int k = 0; k < columns * rows; ++k)
    tracked.add(k, {30 + step_px.x() * (k % columns), 25 + step_px.y() * (k / columns)}, kLeft,
                Raster<float>(100, 80, 50.0f), still);
  tracked.anchor(flatModel(), &on_cpu);
  tracked.look({texture(), Mask()}, flatModel(), kLeft, still, {});
  return tracked;
}

// Twenty points that chance has moved by 0.3 mm in each direction.
TEST(MaterialPoints, PredictHowFarTheirWarpLeadsAstray) {
  const auto still = Eigen::Isometry3d::Identity();
  MaterialPoints tracked = lookedAt(5, 4, {10, 10});
  std::mt19937 random(3);
  std::normal_distribution<double> deviate_mm(0, 0.3);
  const std::vector<MaterialPoints::Point> truth = tracked.points;
  for (MaterialPoints::Point& point : tracked.points)
    point.position_mm += Eigen::Vector3d(deviate_mm(random), deviate_mm(random), 0);
  tracked.align(looksIn(texture()), kLeft, still, kNodeSpacingMm, everywhere);
  EXPECT_GT(std::sqrt(tracked.drift_mm2), 0.2);
  EXPECT_LT(std::sqrt(tracked.drift_mm2), 0.45);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_LT((tracked.points[k].position_mm - truth[k].position_mm).norm(), 0.03) << k;
    EXPECT_LT(std::sqrt(tracked.points[k].variance_mm2), 0.1) << k;
  }
  // An image without texture confirms nothing; what it does not show is not known.
  MaterialPoints unsure = tracked;
  unsure.align(looksIn(GrayImage(100, 80, 120)), kLeft, still, kNodeSpacingMm, everywhere);
  EXPECT_NEAR(unsure.points[7].variance_mm2, tracked.points[7].variance_mm2 + tracked.drift_mm2,
              1e-12);
  tracked.align(looksIn(texture()), kLeft, still, kNodeSpacingMm,
                [](const Eigen::Vector3d&) { return false; });
  EXPECT_TRUE(std::isnan(tracked.points[7].variance_mm2));
  EXPECT_LT((tracked.points[7].position_mm - truth[7].position_mm).norm(), 0.03);
}

// Forty points that the warp has led half a millimetre astray; of a quarter of them the image shows
// nothing.
TEST(MaterialPoints, GoWithTheirNeighboursWhereTheyAreNotSeen) {
  const auto still = Eigen::Isometry3d::Identity();
  MaterialPoints tracked = lookedAt(8, 5, {5, 6});
  const std::vector<MaterialPoints::Point> truth = tracked.points;
  const Eigen::Vector3d astray_mm(0.4, -0.3, 0);
  for (MaterialPoints::Point& point : tracked.points) point.position_mm += astray_mm;
  for (std::size_t k = 0; k < truth.size(); k += 4) tracked.points[k].look = FirstLook();
  MaterialPoints far = tracked;
  tracked.align(looksIn(texture()), kLeft, still, kNodeSpacingMm, everywhere);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double off_mm = (tracked.points[k].position_mm - truth[k].position_mm).norm();
    EXPECT_LT(off_mm, k % 4 == 0 ? 0.2 : 0.03) << k;
  }
  // Distant points have no effect.
  far.points[0].position_mm.x() += 60;
  const Eigen::Vector3d alone_mm = far.points[0].position_mm;
  far.align(looksIn(texture()), kLeft, still, kNodeSpacingMm, everywhere);
  EXPECT_EQ(far.points[0].position_mm, alone_mm);
}

TEST(MaterialPoints, HaveNoPositionBeforeTheyWereMeasuredTwice) {
  MaterialPoints tracked;
  tracked.points.resize(2);
  tracked.points[0].id = 4;
  tracked.points[1].id = 5;
  const Eigen::Vector3d place(1, 2, 40);
  const auto reported = [&](bool is_measured) {
    std::vector<TrackedPosition> positions{{4, place, true, 0.1, true},
                                           {5, place, true, 0.1, is_measured}};
    tracked.countMeasured(positions);
    tracked.hideUnmeasured(&positions);
    return positions;
  };
  const std::vector<TrackedPosition> first = reported(false);
  EXPECT_EQ(first[0].position_mm, place) << "of one frame, one measurement is all there is";
  EXPECT_TRUE(first[1].position_mm.array().isNaN().all());
  EXPECT_FALSE(first[1].visible);
  EXPECT_TRUE(reported(true)[1].position_mm.array().isNaN().all());
  EXPECT_EQ(reported(false)[0].position_mm, place);
  EXPECT_EQ(reported(true)[1].position_mm, place);
  EXPECT_EQ(reported(false)[1].position_mm, place) << "hidden again, it is where it went";
}

// What the first frame alone shows may have the depth of another surface.
TEST(MaterialPoints, LoseThePositionThatOnlyTheFirstFrameMeasured) {
  MaterialPoints tracked;
  tracked.points.resize(1);
  const Eigen::Vector3d place(1, 2, 40);
  const auto reported = [&](bool is_measured) {
    std::vector<TrackedPosition> positions{{0, place, is_measured, 0.1, is_measured}};
    tracked.countMeasured(positions);
    tracked.hideUnmeasured(&positions);
    return positions.front().position_mm;
  };
  EXPECT_EQ(reported(true), place);
  EXPECT_TRUE(reported(false).array().isNaN().all());
  EXPECT_EQ(reported(true), place);
}

TEST(PreciseShare, IsOfTheVisiblePointsWithATolerableError) {
  const Eigen::Vector3d anywhere(1, 2, 3);
  EXPECT_TRUE(std::isnan(preciseShare({})));
  EXPECT_TRUE(std::isnan(preciseShare({{1, anywhere, false, 0.1}})));
  EXPECT_EQ(preciseShare({{1, anywhere, true, 0.51},
                          {2, anywhere, true, 0.52},
                          {3, anywhere, true, std::nan("")},
                          {4, anywhere, true, 0.1},
                          {5, anywhere, false, 0.1}}),
            0.5);
}

}  // namespace
}  // namespace softscope
