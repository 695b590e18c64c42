// tests/fusion/density_test.cpp: one point a cell, nothing lost on the way.
#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/cell_table.h"
#include "fusion/density_grid.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

const Eigen::Vector3f kUp(0, 0, -1);

PointModel cloud(int count, unsigned seed, float extent_mm) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-extent_mm, extent_mm), weight(0.1f, 10);
  PointModel model;
  for (int i = 0; i < count; ++i)
    model.add({place(random), place(random), 55 + 0.05f * place(random) / extent_mm}, kUp,
              {static_cast<std::uint8_t>(i), 0, 0}, weight(random));
  return model;
}

TEST(CellKeys, TellNeighboursApartAndRefuseTheRest) {
  const Eigen::Vector3f cell = Eigen::Vector3f::Constant(0.2f);
  EXPECT_EQ(cellKey({0.01f, 0.01f, 0.01f}, cell), cellKey({0.19f, 0.19f, 0.19f}, cell));
  EXPECT_NE(cellKey({0.01f, 0, 0}, cell), cellKey({-0.01f, 0, 0}, cell));
  EXPECT_NE(cellKey({0.01f, 0, 0}, cell), cellKey({0.21f, 0, 0}, cell));
  EXPECT_NE(cellKey({0, 0.3f, 0}, cell), cellKey({0, 0, 0.3f}, cell));
  EXPECT_EQ(cellKey({1e6f, 0, 0}, cell), kNoCell);
  EXPECT_EQ(cellKey({0, kNoDepth, 0}, cell), kNoCell);
  EXPECT_EQ(cellKey({0, 0, -std::numeric_limits<float>::infinity()}, cell), kNoCell);
}

TEST(KeepDensity, LeavesOnePointACell) {
  PointModel model = cloud(20000, 1, 5);
  keepDensity({}, {}, &model);
  const Eigen::Vector3f cell = Eigen::Vector3f::Constant(0.2f);
  std::vector<CellKey> keys;
  for (const Eigen::Vector3f& p : model.positions_mm) keys.push_back(cellKey(p, cell));
  std::sort(keys.begin(), keys.end());
  // Points stay at their place along the surface; only height is averaged, within one cell's.
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_GT(model.size(), 2000u);  // 50 x 50 cells, nearly all hit; two layers of them
  EXPECT_LE(model.size(), 5000u);
}

TEST(KeepDensity, MapsEveryOldPointToTheOneThatStandsForIt) {
  const PointModel before = cloud(20000, 2, 5);
  PointModel model = before;
  const IndexMap map = keepDensity({}, {}, &model);
  ASSERT_EQ(map.new_of_old.size(), before.size());
  ASSERT_EQ(static_cast<std::size_t>(map.new_count), model.size());
  EXPECT_EQ(model.normals.size(), model.size());
  EXPECT_EQ(model.colours.size(), model.size());
  EXPECT_EQ(model.anchors.size(), model.size());
  EXPECT_EQ(model.weights.size(), model.size());
  EXPECT_EQ(model.bindings.size(), model.size());
  std::vector<std::int32_t> carriers(model.size(), 0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::int32_t k = map.new_of_old[i];
    ASSERT_GE(k, 0);
    ++carriers[k];
    EXPECT_LE((model.positions_mm[k] - before.positions_mm[i]).norm(), 0.2f * std::sqrt(3.0f));
    EXPECT_GE(model.weights[k], before.weights[i]);  // the point of the largest weight is kept
  }
  EXPECT_EQ(std::count(carriers.begin(), carriers.end(), 0), 0);
}

TEST(KeepDensity, KeepsTheOrder) {
  PointModel model;
  for (int i = 0; i < 200; ++i)  // every third on top of its predecessor
    model.add({0.5f * static_cast<float>(i - (i % 3 == 2)), 0.1f, 55.1f}, kUp,
              {static_cast<std::uint8_t>(i), 0, 0}, i % 3 == 2 ? 2.0f : 1.0f);
  const IndexMap map = keepDensity({}, {}, &model);
  ASSERT_EQ(model.size(), 134u);
  for (std::size_t k = 1; k < model.size(); ++k)
    EXPECT_GT(model.colours[k].red, model.colours[k - 1].red);
  EXPECT_EQ(map.new_of_old[1], map.new_of_old[2]);
}

TEST(KeepDensity, MergesHeightByWeightAndKeepsThePlace) {
  PointModel model;
  model.add({0.02f, 0.1f, 55.02f}, kUp, {10, 10, 10}, 1);
  model.add({0.18f, 0.1f, 55.18f}, kUp, {90, 90, 90}, 3);
  model.bindings[0] = {7, {1, 0, 0, 0}};
  const IndexMap map = keepDensity({}, {}, &model);
  ASSERT_EQ(model.size(), 1u);
  EXPECT_EQ(map.new_of_old, (std::vector<std::int32_t>{0, 0}));
  EXPECT_FLOAT_EQ(model.positions_mm[0].x(), 0.18f);
  EXPECT_NEAR(model.positions_mm[0].z(), 0.25 * 55.02 + 0.75 * 55.18, 1e-5);
  EXPECT_FLOAT_EQ(model.weights[0], 3);
  EXPECT_EQ(model.colours[0].red, 90);
  EXPECT_EQ(model.anchors[0], 90);
  EXPECT_EQ(model.bindings[0].stencil, 7);  // the only one that is carried by nodes
}

TEST(KeepDensity, LeavesTheTwoSidesOfAFoldAlone) {
  PointModel model;
  model.add({0.05f, 0.05f, 55.05f}, kUp, {}, 1);
  model.add({0.06f, 0.05f, 55.06f}, -kUp, {}, 1);
  model.add({0.07f, 0.05f, 55.07f}, kUp, {}, 1);
  EXPECT_EQ(keepDensity({}, {}, &model).new_of_old, (std::vector<std::int32_t>{0, 1, 0}));
}

TEST(KeepDensity, RemovesWhatHasNoWeightNoPlaceOrNoNormal) {
  const float nan = kNoDepth, inf = std::numeric_limits<float>::infinity();
  PointModel model;
  model.add({nan, 0, 55}, kUp, {}, 1);
  model.add({1, 0, 55}, kUp, {}, 0);
  model.add({2, 0, 55}, kUp, {}, -1);
  model.add({3, 0, 55}, kUp, {}, nan);
  model.add({4, inf, 55}, kUp, {}, 1);
  model.add({5, 0, 3e38f}, kUp, {}, 1);
  model.add({6, 0, 55}, {nan, 0, 0}, {}, 1);
  model.add({7, 0, 55}, {0, 0, 0}, {}, 1);
  model.add({8, 0, 55}, kUp, {}, 1);
  EXPECT_EQ(keepDensity({}, {}, &model).new_of_old,
            (std::vector<std::int32_t>{-1, -1, -1, -1, -1, -1, -1, -1, 0}));
  EXPECT_FLOAT_EQ(model.positions_mm.at(0).x(), 8);
}

TEST(KeepDensity, ChangesNothingTheSecondTime) {
  PointModel model = cloud(20000, 3, 5);
  keepDensity({}, {}, &model);
  const PointModel once = model;
  const IndexMap map = keepDensity({}, {}, &model);
  EXPECT_TRUE(map.identity());
  EXPECT_TRUE(sameModel(once, model));
}

// Cells of 0.2 mm are 10 px wide at 20 mm, and 2.4 px are enough: three halvings.
TEST(KeepDensity, LeavesMorePointsWhereTissueIsNear) {
  PosedCamera camera;
  camera.fx_px = 1000;
  for (const auto& [depth_mm, left] : {std::pair(20.0f, 4), std::pair(100.0f, 1)}) {
    PointModel model;
    for (int i = 0; i < 4; ++i) model.add({0.01f + 0.05f * i, 0.01f, depth_mm}, kUp, {}, 1);
    keepDensity({}, camera, &model);
    EXPECT_EQ(model.size(), static_cast<std::size_t>(left)) << depth_mm << " mm";
  }
}

TEST(KeepDensity, AcceptsTheEmptyModelAndRefusesBadOptions) {
  PointModel model;
  EXPECT_TRUE(keepDensity({}, {}, &model).identity());
  EXPECT_THROW(keepDensity({0.0}, {}, &model), OptionError);
}

TEST(KeepDensity, IsTheSameForAnyNumberOfThreads) {
  PointModel many = cloud(50000, 4, 8), alone = many;
  keepDensity({}, {}, &many);
  const ThreadLimit one(1);
  keepDensity({}, {}, &alone);
  EXPECT_TRUE(sameModel(many, alone));
}

// A crowd in one cell is the worst case of the table: it must not take quadratic time.
TEST(KeepDensity, SurvivesACrowd) {
  PointModel model;
  std::mt19937 random(5);
  std::normal_distribution<float> any;
  for (int i = 0; i < 100000; ++i)
    model.add({0.1f, 0.1f, 55.1f},
              Eigen::Vector3f(any(random), any(random), any(random)).normalized(), {}, 1);
  keepDensity({}, {}, &model);
  EXPECT_LT(model.size(), 40u);  // directions 60 degrees apart: no more fit on a sphere
}

}  // namespace
}  // namespace softscope::test
