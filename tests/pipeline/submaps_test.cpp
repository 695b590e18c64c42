// tests/pipeline/submaps_test.cpp: maps set aside, found again and united.
#include "pipeline/submaps.h"

#include <gtest/gtest.h>

#include <set>

#include "pipeline/frame/tissue_colour.h"
#include "pipeline/model/united_models.h"

namespace softscope {
namespace {

Eigen::Isometry3d at(double x_mm) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = x_mm;
  return pose;
}

Submap mapOf(int number, int frames) {
  Submap map;
  map.scope.map = number;
  map.scope.fused_frames = frames;
  return map;
}

TEST(ScopeState, TriesEveryViewInItsTurn) {
  ScopeState scope;
  for (int i = 1; i <= 4; ++i) scope.remember(at(20 * i));
  scope.remember(at(81));  // near the last one
  ASSERT_EQ(scope.key_views.size(), 4u);
  std::multiset<double> tried;
  for (scope.searches = 0; scope.searches < 5; ++scope.searches)
    for (const Eigen::Isometry3d& view : scope.viewpointsToTry(2))
      tried.insert(view.translation().x());
  for (int i = 0; i <= 4; ++i) EXPECT_EQ(tried.count(20 * i), 2u) << i;
}

TEST(ScopeState, IsSearchedOnceEveryViewWasTriedTwice) {
  ScopeState scope;
  scope.searches = 9;
  EXPECT_FALSE(scope.isSearched());
  scope.searches = 10;
  EXPECT_TRUE(scope.isSearched());
}

TEST(Submaps, KeepTheFirstMapAndForgetTheSmallest) {
  Submaps maps;
  maps.add(mapOf(0, 1));
  maps.add(mapOf(1, 4));  // too small
  for (int i = 2; i <= 9; ++i) maps.add(mapOf(i, 5 + i % 3));
  std::set<int> kept;
  for (const Submap& map : maps.all()) kept.insert(map.scope.map);
  EXPECT_EQ(kept, (std::set<int>{0, 2, 4, 5, 6, 7, 8, 9}));
}

TEST(Submaps, TakeTurns) {
  Submaps maps;
  for (int i = 0; i < 3; ++i) maps.add(mapOf(i, 10));
  std::vector<int> turns;
  for (int i = 0; i < 6; ++i) turns.push_back(maps.next().scope.map);
  EXPECT_EQ(turns, (std::vector<int>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(maps.take().scope.map, 2);
  EXPECT_EQ(maps.all().size(), 2u);
}

ModelState rowOfPoints(float from_mm, float to_mm) {
  ModelState state;
  for (float x = from_mm; x < to_mm; x += 0.5F)
    state.model.add({x, 0, 50}, {0, 0, -1}, {100, 50, 40}, 3);
  return state;
}

// Two rows that overlap from 10 to 20 mm, one in a world that is moved by 5 mm.
TEST(UnitedModels, AddWhatTheOtherLacksInItsWorldAndLight) {
  ModelState into = rowOfPoints(0, 20);
  ModelState other = rowOfPoints(5, 25);
  other.exposure = {1.2F, 1.2F, 1.2F};
  const std::size_t before = into.model.size();
  uniteModels(other, at(5), &into);
  const PointModel& model = into.model;
  ASSERT_GT(model.size(), before + 15);  // 20 points lie beyond, some next to the first row
  ASSERT_LE(model.size(), before + 20);
  for (std::size_t i = before; i < model.size(); ++i) {
    EXPECT_GT(model.positions_mm[i].x(), 20);
    EXPECT_LT(model.positions_mm[i].x(), 30);
    EXPECT_EQ(model.colours[i].red, 120);
    EXPECT_EQ(model.weights[i], 3);
    EXPECT_FALSE(model.bindings[i].bound());
  }
}

TEST(TissueColour, TellsGauzeFromTissue) {
  const PointModel tissue = rowOfPoints(0, 20).model;
  Raster<float> depth_mm(8, 8, 50.0F);
  EXPECT_TRUE(isAsRed(ColourImage(8, 8, {60, 30, 25}), depth_mm, tissue));
  EXPECT_FALSE(isAsRed(ColourImage(8, 8, {100, 95, 90}), depth_mm, tissue));
  depth_mm = Raster<float>(8, 8, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(isAsRed(ColourImage(8, 8, {60, 30, 25}), depth_mm, tissue)) << "nothing measured";
}

}  // namespace
}  // namespace softscope
