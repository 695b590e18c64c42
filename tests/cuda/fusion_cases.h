// tests/cuda/fusion_cases.h: frames whose fusion by kernels must be the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "comparison_cases.h"
#include "fusion/frame_comparer.h"
#include "fusion/frame_survey.h"
#include "fusion/model_updater.h"
#include "survey_frame.h"

namespace softscope::test {

/// What stage 7 leaves.
struct UpdatedModel {
  ModelUpdateSummary summary;
  PointModel model;
  InsertionMemory memory;
};

template <class T>
bool haveSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Everything, as bytes.
inline void expectSameUpdate(const UpdatedModel& found, const UpdatedModel& expected) {
  EXPECT_EQ(found.summary.seen, expected.summary.seen);
  EXPECT_EQ(found.summary.points.fused, expected.summary.points.fused);
  EXPECT_EQ(found.summary.points.contradicted, expected.summary.points.contradicted);
  EXPECT_EQ(found.summary.insertion.unexplained_px, expected.summary.insertion.unexplained_px);
  EXPECT_EQ(found.summary.insertion.inserted, expected.summary.insertion.inserted);
  EXPECT_EQ(found.summary.index_map.new_count, expected.summary.index_map.new_count);
  EXPECT_EQ(found.summary.index_map.new_of_old, expected.summary.index_map.new_of_old);
  const PointModel &model = found.model, &other = expected.model;
  EXPECT_TRUE(haveSameBytes(model.positions_mm, other.positions_mm));
  EXPECT_TRUE(haveSameBytes(model.normals, other.normals));
  EXPECT_TRUE(haveSameBytes(model.colours, other.colours));
  EXPECT_TRUE(haveSameBytes(model.anchors, other.anchors));
  EXPECT_TRUE(haveSameBytes(model.weights, other.weights));
  EXPECT_TRUE(haveSameBytes(model.bindings, other.bindings));
  EXPECT_TRUE(
      haveSameBytes(found.memory.unexplained_mm.values, expected.memory.unexplained_mm.values));
  EXPECT_EQ(found.memory.unexplained_mm.width_px, expected.memory.unexplained_mm.width_px);
  EXPECT_EQ(found.memory.world_from_left.matrix(), expected.memory.world_from_left.matrix());
}

/// A scene with a model. Its first update begins with an empty model; the second confirms new
/// points by a memory of the image's left half, and finds points of every fate.
class FusionScene {
 public:
  explicit FusionScene(const ComparisonCase& of)
      : scene_(of), options_(scene_.options()), confirms_(of.has_sigma) {
    comparison_ =
        compareModel(scene_.model(), scene_.graph(), observation_, scene_.states(), options_);
  }

  static PinholeCamera camera() { return ComparisonScene::camera(); }

  UpdatedModel begin(ModelUpdater* updater) const {
    UpdatedModel made;
    updater->changed(kWholeModel);
    made.summary = updater->update(observation_, scene_.states(), WarpGraph(), options_,
                                   ModelComparison(), &made.memory, &made.model);
    updater->fetch(&made.memory);
    return made;
  }
  UpdatedModel goOn(ModelUpdater* updater) const {
    UpdatedModel made;
    made.model = scene_.model();
    made.memory = begin(updater).memory;
    forgetRight(&made.memory.unexplained_mm);
    FusionOptions options = options_;
    options.insertion.confirm = confirms_;
    updater->changed(kWholeModel);
    made.summary = updater->update(observation_, scene_.states(), scene_.graph(), options,
                                   comparison_, &made.memory, &made.model);
    updater->fetch(&made.memory);
    return made;
  }
  /// Three frames over what update() left where it lies, with the comparer's questions before and
  /// after; the host's model is told to have changed before the second. With a survey, the
  /// frames lie where it leaves them.
  UpdatedModel follow(FrameComparer* comparer, ModelUpdater* updater,
                      FrameSurvey* survey = nullptr) const {
    UpdatedModel made;
    made.model = scene_.model();
    updater->changed(kWholeModel);
    for (int frame = 0; frame < 3; ++frame) {
      if (frame == 1) {
        for (Eigen::Vector3f& point : made.model.positions_mm) point.z() += 0.02f;
        updater->changed(kModelShape);
      }
      if (survey != nullptr) {
        surveyFrame(observation_, options_.pixels, survey);
        survey->use(observation_.depth);
      }
      comparer->visiblePoints(made.model, observation_, scene_.states(), options_.visibility);
      const FrameComparison found =
          comparer->compare(made.model, scene_.graph(), observation_, scene_.states(), options_);
      made.summary = updater->update(observation_, scene_.states(), scene_.graph(), options_,
                                     found.model, &made.memory, &made.model);
      EXPECT_GT(comparer->error(made.model, observation_, scene_.states()).compared_px, 1000);
    }
    updater->fetch(&made.memory);
    return made;
  }

  void expectEveryFate(const UpdatedModel& made) const {
    EXPECT_GT(made.summary.points.fused, 1000);
    EXPECT_GT(made.summary.points.contradicted, 100);
    EXPECT_GT(made.summary.insertion.inserted, 100);
    EXPECT_LT(made.summary.index_map.new_count + 10,
              static_cast<std::int32_t>(made.summary.index_map.new_of_old.size()));
  }

  const ComparisonScene& scene() const { return scene_; }

 private:
  static void forgetRight(Raster<float>* depth_mm) {
    for (int v = 0; v < depth_mm->height_px; ++v)
      std::fill(depth_mm->row(v) + depth_mm->width_px / 2, depth_mm->row(v) + depth_mm->width_px,
                kNoDepth);
  }

  ComparisonScene scene_;
  FusionOptions options_;
  bool confirms_;
  Observation observation_ = scene_.observation();
  ModelComparison comparison_;
};

/// A model of which hundreds of points share a cell, on both sides of a surface, bound or not;
/// outside the image, so that density alone changes it.
inline UpdatedModel thinCrowd(const FusionScene& scene, ModelUpdater* updater) {
  UpdatedModel made;
  for (int i = 0; i < 3000; ++i) {
    const float side = i % 7 < 3 ? 1.0f : -1.0f, away = static_cast<float>(i * 37 % 100) / 999;
    made.model.add({1000.05f + 0.2f * static_cast<float>(i % 5), 0.05f + away, 60.05f + away / 9},
                   Eigen::Vector3f(0.1f * away, 0, -side).normalized(),
                   {static_cast<std::uint8_t>(i % 200), 80, 90},
                   1 + static_cast<float>(i * 13 % 17));
    if (i % 3 == 0) made.model.bindings.back() = {i % 2, {0.25f, 0.25f, 0.25f, 0.25f}};
  }
  ModelComparison outside;
  outside.visibility.points.resize(made.model.size());
  updater->changed(kWholeModel);
  made.summary =
      updater->update(scene.scene().observation(), scene.scene().states(), scene.scene().graph(),
                      scene.scene().options(), outside, &made.memory, &made.model);
  updater->fetch(&made.memory);
  return made;
}

}  // namespace softscope::test
