// cuda/pose/pose_run.h: memory, copies and launches of the pose search, on any machine.
#pragma once

#include <algorithm>
#include <utility>

#include "cuda/device/arena.h"
#include "cuda/pose/pose_search.h"
#include "pose/refine_pose.h"

namespace softscope::cuda {

struct PoseLayout {
  explicit PoseLayout(Arena& arena)
      : inputs(arena.array<PoseInputs>(1)),
        pairs(arena.array<SeenPair>(kMostPosePairs)),
        ends(arena.array<PoseEnd>(kPoseSearches)),
        facts(arena.array<PoseFacts>(2)) {}

  PoseInputs* inputs;
  SeenPair* pairs;
  PoseEnd* ends;
  PoseFacts* facts;
};

/// Machine: as in WarpRun.
template <class Machine>
class PoseRun final : public PoseSearch {
 public:
  template <class... Arguments>
  explicit PoseRun(Arguments&&... arguments)
      : machine_(std::forward<Arguments>(arguments)...),
        memory_(bytesNeeded(), "memory for the pose"),
        arena_(memory_.data()),
        layout_(arena_) {}

  /// The sums differ from those of the CPU by rounding.
  PoseAnswer answer(const PoseQuestion& question) override {
    if (question.pairs.size() > kMostPosePairs) return CpuPoseSearch().answer(question);
    const PoseInputs inputs = inputsOf(question);
    machine_.toDevice(layout_.inputs, &inputs, sizeof inputs);
    if (!question.pairs.empty())
      machine_.toDevice(layout_.pairs, question.pairs.data(),
                        question.pairs.size() * sizeof(SeenPair));
    machine_.executor().launch(
        "search pose",
        SearchPoseKernel{layout_.inputs, layout_.pairs, layout_.ends, question.iterations},
        Grid{kPoseSearches, 1, 1});
    machine_.executor().launch(
        "judge pose", JudgePoseKernel{layout_.inputs, layout_.pairs, layout_.ends, layout_.facts},
        Grid{2, 1, 1});
    PoseFacts facts[2];
    machine_.fromDevice(facts, layout_.facts, sizeof facts);
    machine_.wait();
    return {findingsOf(facts[0]), findingsOf(facts[1])};
  }

 private:
  static std::size_t bytesNeeded() {
    Arena counting;
    const PoseLayout planned(counting);
    return counting.bytes();
  }
  static PoseInputs inputsOf(const PoseQuestion& question) {
    PoseInputs inputs{};
    inputs.rig = question.rig;
    inputs.regions = question.regions;
    const Eigen::Isometry3d* starts[] = {&question.fitted, &question.old, &question.before};
    for (int s = 0; s < kPoseStarts; ++s) inputs.starts[s] = rowsOf(*starts[s]);
    inputs.scale_of_median = question.scale_of_median;
    inputs.pairs = static_cast<int>(question.pairs.size());
    return inputs;
  }
  static PoseFindings findingsOf(const PoseFacts& facts) {
    PoseFindings found;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) found.best(i, j) = facts.best.at[i][j];
    if (facts.compared > 0) {
      found.shift = facts.medians[0];
      found.length = facts.medians[1];
      found.old_length = facts.medians[2];
    }
    std::copy_n(facts.gains, kRegions, found.gains.begin());
    std::copy_n(facts.counts, kRegions, found.counts.begin());
    std::copy_n(facts.score_counts, kRegions, found.score_counts.begin());
    found.explained = facts.explained;
    for (std::size_t r = 0; r < kRegions; ++r) {
      found.normals[r] = symmetric(facts.normals[r]);
      found.scores[r] = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(facts.scores[r]);
    }
    return found;
  }
  static Eigen::Matrix<double, 6, 6> symmetric(const double (&triangle)[triangleSize(6)]) {
    Eigen::Matrix<double, 6, 6> full;
    for (int i = 0, at = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j, ++at) full(i, j) = full(j, i) = triangle[at];
    return full;
  }

  using Memory = typename Machine::Memory;
  Machine machine_;
  Memory memory_;
  Arena arena_;
  PoseLayout layout_;
};

}  // namespace softscope::cuda
