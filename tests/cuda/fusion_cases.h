// tests/cuda/fusion_cases.h: frames whose fusion by kernels must be the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "comparison_cases.h"
#include "fusion/model_update.h"
#include "fusion_run.h"

namespace softscope::test {

/// A scene with a model, and the stage's result on the CPU.
class FusionScene {
 public:
  explicit FusionScene(const ComparisonCase& of) : scene_(of), options_(scene_.options()) {
    comparison_ =
        compareModel(scene_.model(), scene_.graph(), observation_, scene_.states(), options_);
    PointModel unused = scene_.model();
    updateModel(observation_, scene_.states(), scene_.graph(), options_, comparison_, &memory_,
                &unused);
    options_.insertion.confirm = of.has_sigma;  // by a memory of the image's left half
    Raster<float>& last_mm = memory_.unexplained_mm;
    for (int v = 0; v < last_mm.height_px; ++v)
      std::fill(last_mm.row(v) + last_mm.width_px / 2, last_mm.row(v) + last_mm.width_px, kNoDepth);
    expected_ = scene_.model();
    InsertionMemory memory = memory_;
    summary_ = updateModel(observation_, scene_.states(), scene_.graph(), options_, comparison_,
                           &memory, &expected_);
    expected_mm_ = memory.unexplained_mm;
  }

  /// Lives as long as this scene.
  FusionInputs inputs() const {
    return {observation_, scene_.model(), scene_.graph(), comparison_, memory_, options_};
  }

  /// Equal bytes; the scene has points of every fate.
  void expectSame(const FusionResult& found) const {
    EXPECT_GT(summary_.points.fused, 1000);
    EXPECT_GT(summary_.points.contradicted, 100);
    EXPECT_GT(summary_.insertion.inserted, 100);
    EXPECT_EQ(found.states, scene_.states().values);
    expectSameDepths(found.unexplained_mm);
    EXPECT_EQ(found.inserted, summary_.insertion.inserted);
    ASSERT_EQ(found.points.size(), expected_.size());
    EXPECT_LT(found.points.size() + 10, static_cast<std::size_t>(found.before_density));
    int apart = 0;
    for (std::size_t i = 0; i < expected_.size(); ++i) apart += !isExpected(found.points[i], i);
    EXPECT_EQ(apart, 0);
  }

 private:
  void expectSameDepths(const std::vector<float>& found_mm) const {
    ASSERT_EQ(found_mm.size(), expected_mm_.size());
    int apart = 0;
    for (std::size_t i = 0; i < found_mm.size(); ++i) {
      const float found = found_mm[i], expected = expected_mm_.values[i];
      apart += !(found == expected || (std::isnan(found) && std::isnan(expected)));
    }
    EXPECT_EQ(apart, 0);
  }
  bool isExpected(const ModelPoint& point, std::size_t i) const {
    return point.position_mm == expected_.positions_mm[i] && point.normal == expected_.normals[i] &&
           point.colour == expected_.colours[i] && point.anchor == expected_.anchors[i] &&
           point.weight == expected_.weights[i];
  }

  ComparisonScene scene_;
  FusionOptions options_;
  Observation observation_ = scene_.observation();
  ModelComparison comparison_;
  InsertionMemory memory_;
  PointModel expected_;
  Raster<float> expected_mm_;
  ModelUpdateSummary summary_;
};

}  // namespace softscope::test
