// tests/cuda/warp_cases.h: frames whose warp on a device must have the CPU's energy.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "deform/solver/device_warp_system.h"
#include "deform/solver/lm_solver.h"
#include "deform/solver/local_solver.h"
#include "tests/deform/scenes.h"

namespace softscope::test {

struct WarpCase {
  const char* name;
  double width_mm, height_mm, spacing_mm;
  bool has_surface;
  int match_stride;            // 0: no matches
  double visible_share = 0.5;  // of the half with x > 0
  double step_mm = 0.5;        // between points
  PinholeCamera camera{200, 150, 240, 240, 99.5, 74.5};
};

inline std::vector<WarpCase> warpCases() {
  return {{"surfaceAndMatches", 44, 32, 4, true, 40},
          {"surfaceAlone", 30, 24, 4, true, 0},
          {"matchesAlone", 30, 24, 4, false, 15},
          {"oneFront", 9, 8, 4, true, 20},
          {"manyFronts", 48, 36, 2.4, true, 60},
          {"nothing", 12, 10, 4, false, 0},
          // Solved around what is seen, on the left of it.
          {"largeGraph", 120, 24, 1.8, true, 0, -0.7, 0.5, {200, 150, 240, 240, 260, 74.5}}};
}

inline Eigen::Vector3d bend(const Eigen::Vector3d& p) { return scenes::smoothBend(p); }

/// A bent hill with half of its points in sight, and a second patch that nothing pulls.
class WarpScene {
 public:
  explicit WarpScene(const WarpCase& of)
      : spacing_mm_(of.spacing_mm),
        model_(scenes::makeHill(of.width_mm, of.height_mm, of.step_mm)) {
    for (int i = 0; i < 60; ++i)
      model_.add(Eigen::Vector3f(200 + static_cast<float>(i % 8), static_cast<float>(i / 8), 60),
                 {0, 0, -1}, {90, 90, 90}, 1);
    graph_ = scenes::bindGraph(&model_, of.spacing_mm);
    options_.association.max_points = 0;
    for (int i = 0; i < static_cast<int>(model_.size()); ++i)
      if (model_.positions_mm[static_cast<std::size_t>(i)].x() < of.visible_share * of.width_mm / 2)
        visible_.push_back(i);
    if (of.has_surface) {
      view_ = scenes::renderHill(of.camera, bend, of.width_mm + 4, of.height_mm + 4);
      target_ = std::make_unique<DepthTarget>(view_.depth, view_.normals, view_.camera,
                                              Eigen::Isometry3d::Identity(), options_.association);
      seen_.surface = target_.get();
    }
    seen_.visible = &visible_;
    if (of.match_stride > 0) {
      seen_.matches = scenes::makeMatches(model_, bend, of.match_stride);
      for (std::size_t i = 0; i < seen_.matches.size(); i += 9)
        seen_.matches[i].target_mm.x() += 2;  // wrong, and doubted
      if (seen_.matches.size() > 1) seen_.matches[1].target_mm.y() = NAN;
    }
  }

  const DeformOptions& options() const { return options_; }
  const PointModel& model() const { return model_; }
  /// A byte per point of the model.
  std::vector<std::uint8_t> visible() const {
    std::vector<std::uint8_t> visible(model_.size(), 0);
    for (const int point : visible_) visible[static_cast<std::size_t>(point)] = 1;
    return visible;
  }
  const DepthMap& depth() const { return view_.depth; }
  const NormalMap& normals() const { return view_.normals; }
  WarpWeights weights() const { return warpWeights(options_); }
  struct Found {
    DeformSummary summary;
    WarpGraph graph;
  };
  /// As in a run: a large graph is solved around what is seen.
  std::unique_ptr<DeformSolver> local(std::unique_ptr<DeformSolver> solver) const {
    return makeLocalSolver(std::move(solver), spacing_mm_);
  }
  std::unique_ptr<DeformSolver> solverOnTheCpu() const { return local(makeDeformSolver(options_)); }
  Found solve(DeformSolver* solver) const {
    Found found{{}, graph_};
    found.summary = solver->solve(model_, seen_, &found.graph);
    return found;
  }

 private:
  double spacing_mm_;
  PointModel model_;
  WarpGraph graph_;
  DeformOptions options_;
  std::vector<int> visible_;
  scenes::View view_;
  std::unique_ptr<DepthTarget> target_;
  DeformObservation seen_;
};

/// mm, and radians times as much: the furthest apart of two solutions.
inline double furthestApart(const WarpGraph& a, const WarpGraph& b) {
  double furthest = 0;
  for (std::size_t j = 0; j < a.size(); ++j)
    furthest = std::max({furthest, (a.transforms[j].linear - b.transforms[j].linear).norm(),
                         (a.transforms[j].translation_mm - b.transforms[j].translation_mm).norm()});
  return furthest;
}

}  // namespace softscope::test
