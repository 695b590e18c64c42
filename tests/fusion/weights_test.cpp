// tests/fusion/weights_test.cpp: the weights of docs/fusion.md, value by value.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/error.h"
#include "fusion/fusion_weights.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

TEST(FusionWeights, FallWithTheVarianceOfTheDepth) {
  EXPECT_FLOAT_EQ(depthWeight(0.1f, 0.1f, 2), 1);
  EXPECT_FLOAT_EQ(depthWeight(0.2f, 0.1f, 2), 0.25f);
  EXPECT_FLOAT_EQ(depthWeight(0.01f, 0.1f, 2), 2);  // bounded
  EXPECT_FLOAT_EQ(depthWeight(0.5f, 0, 2), 1);      // off
}

TEST(FusionWeights, AreTruncated) {
  EXPECT_FLOAT_EQ(truncationWeight(0.99f, 1, false), 1);
  EXPECT_FLOAT_EQ(truncationWeight(1, 1, false), 0);
  EXPECT_FLOAT_EQ(truncationWeight(-1.5f, 1, false), 0);
  EXPECT_FLOAT_EQ(truncationWeight(0, 1, true), 1);
  EXPECT_FLOAT_EQ(truncationWeight(-0.5f, 1, true), 0.5625f);
  EXPECT_FLOAT_EQ(truncationWeight(kNoDepth, 1, true), 0);
}

TEST(FusionWeights, KeepTheReadingsOfThePaperApart) {
  // As printed, a point on a node never learns anything new.
  EXPECT_FLOAT_EQ(nodeWeight(NodeTrust::kPaper, 0), 0);
  EXPECT_FLOAT_EQ(nodeWeight(NodeTrust::kPaper, 0.4f), 0.4f);
  EXPECT_FLOAT_EQ(nodeWeight(NodeTrust::kPaper, 3), 1);
  EXPECT_FLOAT_EQ(nodeWeight(NodeTrust::kWarpNoise, 0.7f), 1);
}

TEST(FusionWeights, AreLostToTheWarpAwayFromNodes) {
  EXPECT_FLOAT_EQ(weightAfterWarp(10, 0, 0.04f), 10);
  // Variances add: 1/10 + 0.04.
  EXPECT_FLOAT_EQ(weightAfterWarp(10, 1, 0.04f), 1 / 0.14f);
  EXPECT_FLOAT_EQ(weightAfterWarp(10, 5, 0.04f), 1 / 0.14f);
}

TEST(FusionWeights, AreNoLargerThanTheTissueAroundAllows) {
  EXPECT_FLOAT_EQ(weightAfterInnovation(10, 0, 0.1f), 10);
  EXPECT_FLOAT_EQ(weightAfterInnovation(10, 0.0005f, 0.1f), 10);  // variances 0.001 against 0.0005
  EXPECT_FLOAT_EQ(weightAfterInnovation(10, 0.04f, 0.1f), 0.25f);
  EXPECT_FLOAT_EQ(widenedTruncation(1, 0.04f), 1);
  EXPECT_FLOAT_EQ(widenedTruncation(1, 0.25f), 0.5f * 4.685f);
}

TEST(FusionWeights, GoFromTenInFiveContradictionsAndFromOneInTwo) {
  const auto contradictions = [](float weight) {
    int count = 0;
    for (; weight > 0; ++count) weight = contradictedWeight(weight, 1, 0.5f);
    return count;
  };
  EXPECT_EQ(contradictions(10), 5);
  EXPECT_EQ(contradictions(1), 2);
  EXPECT_FLOAT_EQ(contradictedWeight(10, 0.5f, 0.5f), 7.375f);  // by a depth of larger sigma
  EXPECT_FLOAT_EQ(contradictedWeight(10, 1, 0), 10);            // off
}

TEST(FusionWeights, GrowToTheirLimit) {
  EXPECT_FLOAT_EQ(grownWeight(9.5f, 1, 10), 10);
  EXPECT_FLOAT_EQ(grownWeight(3, 0.5f, 10), 3.5f);
  EXPECT_FLOAT_EQ(averagingGain(9, 1), 0.1f);
  EXPECT_FLOAT_EQ(averagingGain(0, 0), 0);
}

/// A model of one point, 0.3 mm in front of a plane at 55 mm, carried by a node `away_mm` from it.
float depthAfterOneUpdate(NodeTrust trust, float away_mm) {
  const Shot shot = takeShot(plane(55), smallCamera());
  WarpGraph graph;
  graph.positions_mm = {Eigen::Vector3d(away_mm, 0, 54.7)};
  graph.stencils = {{0, 0, 0, 0}};
  PointModel model;
  model.add({0, 0, 54.7f}, {0, 0, -1}, {}, 5);
  model.bindings[0] = {0, {1, 0, 0, 0}};
  FusionOptions options;
  options.points.node_trust = trust;
  options.points.reference_sigma_mm = 0.1;
  options.points.warp_sigma_mm = 0.1;
  options.points.follow_innovation = false;  // a second reason to follow
  InsertionMemory memory;
  update(shot, graph, options, &memory, &model);
  return model.positions_mm[0].z();
}

// Tissue between nodes is carried less well, so there the new measurement must count for more
// against what was carried along. Printed formula and warp noise agree on that.
TEST(FusionWeights, FollowTheMeasurementMoreFarFromNodes) {
  EXPECT_GT(depthAfterOneUpdate(NodeTrust::kWarpNoise, 2),
            depthAfterOneUpdate(NodeTrust::kWarpNoise, 0) + 0.01f);
  EXPECT_GT(depthAfterOneUpdate(NodeTrust::kPaper, 2),
            depthAfterOneUpdate(NodeTrust::kPaper, 0) + 0.01f);
  EXPECT_FLOAT_EQ(depthAfterOneUpdate(NodeTrust::kPaper, 0), 54.7f);
}

TEST(FusionOptionsTest, AreCheckedFieldByField) {
  EXPECT_NO_THROW(FusionOptions{}.validate());
  EXPECT_NO_THROW(FusionOptions::paper().validate());
  const auto refuses = [](const std::function<void(FusionOptions&)>& spoil, const char* field) {
    FusionOptions options;
    spoil(options);
    try {
      options.validate();
      ADD_FAILURE() << field << " was accepted";
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses([&](auto& o) { o.pixels.max_sigma_mm = nan; }, "fusion.max_sigma_mm");
  refuses([&](auto& o) { o.points.truncation_mm = -1; }, "fusion.truncation_mm");
  refuses([&](auto& o) { o.points.max_weight = 0.5; }, "fusion.max_weight");
  refuses([&](auto& o) { o.colour.highlight_level = 0; }, "colour.highlight_level");
  refuses([&](auto& o) { o.insertion.spacing_mm = 0; }, "fusion.point_spacing_mm");
}

}  // namespace
}  // namespace softscope::test
