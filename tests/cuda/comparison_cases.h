// tests/cuda/comparison_cases.h: models and frames whose comparison on a device must be the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "deform/graph/graph_builder.h"
#include "fusion/frame_comparer.h"
#include "tests/fusion/made_shots.h"

namespace softscope::test {

struct ComparisonCase {
  const char* name;
  bool has_sigma = true, has_colour = true, has_mask = false, has_graph = true;
  FusionOptions options = {};
};

inline std::vector<ComparisonCase> comparisonCases() {
  return {{"whole"},
          {"masked", true, true, true},
          {"withoutSigma", false},
          {"withoutColour", true, false},
          {"withoutGraph", true, true, false, false},
          {"asThePaper", true, true, false, true, FusionOptions::paper()}};
}

/// A sphere before a plane, textured; the model was made of other views and bent since.
class ComparisonScene {
 public:
  explicit ComparisonScene(const ComparisonCase& of) : options_(of.options) {
    InsertionMemory memory;
    options_.insertion.confirm = false;
    const Shot first = shotFrom(shifted(0, 0, 0), 1), second = shotFrom(shifted(5, -3, 2), 2);
    update(first, options_, &memory, &model_);
    update(second, options_, &memory, &model_);
    if (of.has_graph) growGraph(GraphOptions(), &model_, &graph_);
    for (Eigen::Vector3f& p : model_.positions_mm)
      p.z() += 0.3f * std::sin(p.x() / 3) + (p.y() > 6 ? 1.5f : 0.0f);
    for (std::size_t i = 0; i < model_.size(); i += 3) model_.anchors[i] += 3;
    model_.positions_mm[7].x() = std::numeric_limits<float>::quiet_NaN();
    shot_ = shotFrom(shifted(2, -1, 1.5), 3);
    addWrongPatches(0.05, 7, 4, &shot_);
    for (int v = 0; v < shot_.left.height_px; v += 19)  // too unsure for new points
      for (int u = 0; u < shot_.left.width_px; ++u) shot_.depth.sigma_mm.at(u, v) *= 2;
    options_.insertion.max_sigma_over_square_per_mm = 5e-5;
    if (!of.has_sigma) shot_.depth.sigma_mm = {};
    if (!of.has_colour) shot_.colour = {};
    if (of.has_mask) {
      shot_.mask = Mask(shot_.left.width_px, shot_.left.height_px, 0);
      for (int v = 30; v < 70; ++v) std::fill_n(shot_.mask.row(v) + 40, 60, std::uint8_t{255});
    }
    states_ = classifyPixels(observation(), options_.pixels);
  }

  static PinholeCamera camera() { return smallCamera(241, 178, 280); }
  Observation observation() const { return shot_.observation(); }
  const FusionOptions& options() const { return options_; }
  const PointModel& model() const { return model_; }
  const WarpGraph& graph() const { return graph_; }
  const Raster<PixelState>& states() const { return states_; }

  struct Found {
    std::vector<std::int32_t> seen;
    FrameComparison comparison;
    BackProjectionError error;
  };
  Found compareWith(FrameComparer* comparer) const {
    const Observation seen = observation();
    Found found;
    found.seen = comparer->visiblePoints(model_, seen, states_, options_.visibility);
    found.comparison = comparer->compare(model_, graph_, seen, states_, options_);
    found.error = comparer->error(model_, seen, states_);
    return found;
  }

  /// Sums alone may differ, by their rounding to multiples of 2^-26.
  void expectSame(const Found& found, const Found& expected) const {
    EXPECT_EQ(found.seen, expected.seen);
    expectSameError(found.error, expected.error);
    expectSameError(found.comparison.predicted, expected.comparison.predicted);
    const ViewEvidence &view = found.comparison.view, &other = expected.comparison.view;
    EXPECT_EQ(view.blocks, other.blocks);
    EXPECT_EQ(view.agreement(), other.agreement());
    const ModelComparison &model = found.comparison.model, &known = expected.comparison.model;
    EXPECT_EQ(model.gain.red, known.gain.red);
    EXPECT_EQ(model.gain.green, known.gain.green);
    EXPECT_EQ(model.gain.blue, known.gain.blue);
    int apart = 0, disagreeing = 0;
    for (std::size_t i = 0; i < model_.size(); ++i) {
      const PointSight &a = model.visibility.points[i], &b = known.visibility.points[i];
      const bool same_ahead =
          a.ahead_mm == b.ahead_mm || (std::isnan(a.ahead_mm) && std::isnan(b.ahead_mm));
      apart += a.sight != b.sight || a.pixel != b.pixel || !same_ahead;
      const Innovation here = model.innovation.at(graph_, model_.bindings[i]);
      const Innovation there = known.innovation.at(graph_, model_.bindings[i]);
      EXPECT_NEAR(here.difference_mm2, there.difference_mm2, 1e-6);
      EXPECT_NEAR(here.excess_mm2, there.excess_mm2, 1e-6);
    }
    for (std::int32_t pixel = 0; pixel < static_cast<std::int32_t>(states_.size()); ++pixel)
      disagreeing += model.anchored.at(pixel) != known.anchored.at(pixel);
    EXPECT_EQ(apart, 0);
    EXPECT_EQ(disagreeing, 0);
  }

  /// Equal bytes, sums included.
  void expectEqual(const Found& found, const Found& expected) const {
    expectSame(found, expected);
    EXPECT_EQ(found.error.bias_mm, expected.error.bias_mm);
    for (const PointBinding& binding : model_.bindings)
      EXPECT_EQ(found.comparison.model.innovation.at(graph_, binding).excess_mm2,
                expected.comparison.model.innovation.at(graph_, binding).excess_mm2);
  }

 private:
  static void expectSameError(const BackProjectionError& found,
                              const BackProjectionError& expected) {
    EXPECT_GT(expected.compared_px, 1000);
    EXPECT_EQ(found.compared_px, expected.compared_px);
    EXPECT_EQ(found.p95_mm, expected.p95_mm);
    EXPECT_NEAR(found.mean_mm, expected.mean_mm, 1e-8);
    EXPECT_NEAR(found.bias_mm, expected.bias_mm, 1e-8);
  }

  static Shot shotFrom(const Eigen::Isometry3d& pose, unsigned seed) {
    Shot shot = takeShot(nearest(sphere({3, 0, 58}, 12), plane(60, 0.2, 0.1)), camera(), pose);
    addNoise(seed, &shot);
    for (int v = 0; v < shot.left.height_px; ++v)
      for (int u = 0; u < shot.left.width_px; ++u) {
        const Eigen::Vector3d place =
            pose * liftPixel<double>(shot.left, u, v, shot.truth_mm.at(u, v));
        const double gray = 110 + 90 * (solidTexture(place, 1.1) - 0.5) + seed * 4;
        const auto byte = static_cast<std::uint8_t>(std::clamp(std::lround(gray), 0L, 255L));
        shot.colour.at(u, v) = {byte, static_cast<std::uint8_t>(byte / 2),
                                static_cast<std::uint8_t>(byte / 2 + 9)};
      }
    return shot;
  }

  FusionOptions options_;
  PointModel model_;
  WarpGraph graph_;
  Shot shot_;
  Raster<PixelState> states_;
};

}  // namespace softscope::test
