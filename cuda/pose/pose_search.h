// cuda/pose/pose_search.h: kernel bodies of the search for the camera pose.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/small_solve.h"
#include "cuda/device/block_median.h"
#include "cuda/device/kernel.h"
#include "pose/pose_search.h"

namespace softscope::cuda {

constexpr int kPoseThreads = 256, kPairsEach = 6, kMostPosePairs = kPoseThreads * kPairsEach;
using PoseMedian = BlockMedian<kPoseThreads, kPairsEach>;

/// Initial poses of the searches.
enum PoseStart { kFittedPose, kOldPose, kPoseBefore, kPoseStarts };

struct PoseInputs {
  RectifiedRig rig;
  PairRegions regions;
  PoseRows starts[kPoseStarts];
  double scale_of_median;  // see PoseQuestion
  int pairs;
};

/// Result of a search.
struct PoseEnd {
  PoseRows pose;
  double cost;
};

/// Plain data of PoseFindings.
struct PoseFacts {
  PoseRows best;
  double medians[3];  // shift, length, old length
  double gains[kRegions];
  double normals[kRegions][triangleSize(6)];
  double scores[kRegions][6];
  int counts[kRegions], score_counts[kRegions];
  int explained, compared;
};

/// Better result of both searches with one kind of positions: the first of equals.
SOFTSCOPE_HD inline const PoseRows& betterEnd(const PoseEnd* ends) {
  return ends[1].cost < ends[0].cost ? ends[1].pose : ends[0].pose;
}

/// Sums of kCount numbers per thread over a block, in a fixed order. kSteps phases.
template <int kCount>
struct PoseSums {
  static constexpr int kSteps = 4, kHalf = kPoseThreads / 2, kParts = 8;
  static_assert(kCount * kParts <= kPoseThreads);
  struct Shared {
    double half[kCount][kHalf], parts[kCount][kParts], total[kCount];
  };

  template <int kStep>
  SOFTSCOPE_HD static void run(int thread, const double (&own)[kCount], Shared& shared) {
    if constexpr (kStep == 0) {
      if (thread >= kHalf)
        for (int i = 0; i < kCount; ++i) shared.half[i][thread - kHalf] = own[i];
    } else if constexpr (kStep == 1) {
      if (thread < kHalf)
        for (int i = 0; i < kCount; ++i) shared.half[i][thread] += own[i];
    } else if constexpr (kStep == 2) {
      if (thread >= kCount * kParts) return;
      const int i = thread / kParts, part = thread % kParts;
      double sum = 0;
      for (int k = part; k < kHalf; k += kParts) sum += shared.half[i][k];
      shared.parts[i][part] = sum;
    } else {
      if (thread >= kCount) return;
      double sum = 0;
      for (int part = 0; part < kParts; ++part) sum += shared.parts[thread][part];
      shared.total[thread] = sum;
    }
  }
};

/// Normal matrix (lower triangle, by rows) and right-hand side.
constexpr int kPoseSums = triangleSize(6) + 6;

SOFTSCOPE_HD inline void addToSums(const PairResidual& residual, double curvature, double weight,
                                   double (&sums)[kPoseSums]) {
  int at = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j, ++at)
      for (int k = 0; k < 3; ++k)
        sums[at] += curvature * residual.slope[k][i] * residual.slope[k][j];
  for (int i = 0; i < 6; ++i, ++at)
    for (int k = 0; k < 3; ++k) sums[at] -= weight * residual.slope[k][i] * residual.value[k];
}

/// Two searches with either kind of positions.
constexpr int kPoseSearches = 4;

/// One block per search; one Gauss-Newton step per repeat, the final cost in the last one.
struct SearchPoseKernel {
  static constexpr int kThreads = kPoseThreads;
  static constexpr int kSumStep = PoseMedian::kSteps, kStep = kSumStep + PoseSums<1>::kSteps;
  static constexpr int kPhases = kStep + 1;
  struct Shared {
    PoseMedian::Shared median;
    PoseSums<kPoseSums>::Shared sums;
    PoseRows pose;
    bool has_converged;
  };
  struct Local {
    std::uint64_t keys[kPairsEach];
    double sums[kPoseSums];
  };
  const PoseInputs* inputs;
  const SeenPair* pairs;
  PoseEnd* ends;  // of both searches with the places of now, then of both since
  int iterations;

  SOFTSCOPE_HD int repeats(const Place&) const { return iterations + 1; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    if constexpr (kPhase == 0) {
      if (at.repeat == 0 && at.thread == 0) {
        shared.pose = inputs->starts[startOf(at.x)];
        shared.has_converged = false;
      }
      PoseMedian::run<0>(at.thread, local.keys, shared.median);
    } else if constexpr (kPhase < kSumStep) {
      if (at.repeat == iterations || shared.has_converged) return;
      if constexpr (kPhase == 1) findKeys(at, shared.pose, local.keys);
      PoseMedian::run<kPhase>(at.thread, local.keys, shared.median);
    } else if constexpr (kPhase < kStep) {
      if (at.repeat < iterations && shared.has_converged) return;
      if constexpr (kPhase == kSumStep) addUp(at, shared, local.sums);
      PoseSums<kPoseSums>::run<kPhase - kSumStep>(at.thread, local.sums, shared.sums);
    } else {
      if (at.thread != 0) return;
      if (at.repeat == iterations)
        ends[at.x] = {shared.pose, meanCost(shared.sums.total)};
      else if (!shared.has_converged)
        step(shared);
    }
  }

 private:
  SOFTSCOPE_HD static PairPlace placeOf(int search) {
    return search < 2 ? PairPlace::kNow : PairPlace::kSince;
  }
  SOFTSCOPE_HD static PoseStart startOf(int search) {
    if (search % 2 == 0) return kFittedPose;
    return placeOf(search) == PairPlace::kNow ? kOldPose : kPoseBefore;
  }
  SOFTSCOPE_HD PairResidual residualAt(const Place& at, int i, const PoseRows& pose) const {
    return pairResidual(pairs[i], placeOf(at.x), inputs->rig, pose);
  }
  SOFTSCOPE_HD void findKeys(const Place& at, const PoseRows& pose,
                             std::uint64_t (&keys)[kPairsEach]) const {
    for (int k = 0; k < kPairsEach; ++k) {
      keys[k] = PoseMedian::kNoKey;
      const int i = k * kThreads + at.thread;
      if (i >= inputs->pairs) continue;
      const PairResidual residual = residualAt(at, i, pose);
      if (residual.usable) keys[k] = PoseMedian::keyOf(residual.squared());
    }
  }
  /// The last repeat sums costs and counts instead of a normal matrix.
  SOFTSCOPE_HD void addUp(const Place& at, const Shared& shared, double (&sums)[kPoseSums]) const {
    for (double& sum : sums) sum = 0;
    const bool is_step = at.repeat < iterations;
    if (is_step && shared.median.count < 3) return;
    const double scale_sq =
        is_step ? robustScaleSq(shared.median.value(), inputs->scale_of_median) : 1;
    for (int k = 0; k < kPairsEach; ++k) {
      const int i = k * kThreads + at.thread;
      if (i >= inputs->pairs) continue;
      const PairResidual residual = residualAt(at, i, shared.pose);
      if (!residual.usable) continue;
      if (is_step) {
        const double weight = pairWeight(residual.squared(), scale_sq);
        addToSums(residual, weight, weight, sums);
      } else {
        sums[0] += pairCost(residual.squared());
        sums[1] += 1;
      }
    }
  }
  SOFTSCOPE_HD static double meanCost(const double (&total)[kPoseSums]) {
    return total[1] > 0 ? total[0] / total[1] : 1;
  }

  SOFTSCOPE_HD static void step(Shared& shared) {
    double normal[triangleSize(6)], twist[6];
    for (int i = 0; i < triangleSize(6); ++i) normal[i] = shared.sums.total[i];
    for (int i = 0; i < 6; ++i) twist[i] = shared.sums.total[triangleSize(6) + i];
    bool is_finite = shared.median.count >= 3 && factorSymmetric<6>(normal);
    if (is_finite) solveSymmetric<6>(normal, twist);
    for (const double value : twist) is_finite = is_finite && std::isfinite(value);
    shared.has_converged = !is_finite;
    if (!is_finite) return;
    const Eigen::Vector3d turn(twist[0], twist[1], twist[2]), shift(twist[3], twist[4], twist[5]);
    move(turn, shift, &shared.pose);
    shared.has_converged =
        shift.norm() + PoseSearch::kTypicalDepthMm * turn.norm() < PoseSearch::kConvergedMm;
  }
  SOFTSCOPE_HD static void move(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift,
                                PoseRows* pose) {
    Eigen::Matrix3d by = Eigen::Matrix3d::Identity();
    const double angle = turn.norm();
    if (angle > 0) by = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    const PoseRows from = *pose;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        pose->at[i][j] = by(i, 0) * from.at[0][j] + by(i, 1) * from.at[1][j] +
                         by(i, 2) * from.at[2][j] + (j == 3 ? shift(i) : 0);
  }
};

/// One block per kind of positions: three medians, then the sums of regions.
struct JudgePoseKernel {
  static constexpr int kThreads = kPoseThreads;
  static constexpr int kTell = PoseMedian::kSteps, kPhases = kTell + 2;
  static constexpr int kNormal = triangleSize(6), kGain = kPoseSums;
  static constexpr int kRegionSums = kPoseSums + 1;
  static constexpr int kLanes = 7;      // threads of a region, as shared memory allows
  static constexpr int kNoRegion = -1;  // of a pair that is not visible from the best pose
  static_assert(kRegions * kLanes <= kPoseThreads);
  struct Shared {
    PoseMedian::Shared median;
    double lanes[kRegionSums][kRegions * kLanes];
    std::int8_t regions[kMostPosePairs];
    double scale_sq;
    int score_counts[kRegions], counts[kRegions];
    int explained;
  };
  struct Local {
    std::uint64_t keys[kPairsEach];
  };
  const PoseInputs* inputs;
  const SeenPair* pairs;
  const PoseEnd* ends;
  PoseFacts* facts;

  static constexpr int kMedians = 3, kLengths = 1;
  SOFTSCOPE_HD int repeats(const Place&) const { return kMedians; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const bool is_last = at.repeat == kMedians - 1;
    if constexpr (kPhase == 0) {
      if (at.repeat == 0 && at.thread == 0) shared.explained = 0;
      if (at.thread < kRegions) shared.score_counts[at.thread] = shared.counts[at.thread] = 0;
      PoseMedian::run<0>(at.thread, local.keys, shared.median);
    } else if constexpr (kPhase < kTell) {
      if constexpr (kPhase == 1) lookAt(at, shared, local);
      PoseMedian::run<kPhase>(at.thread, local.keys, shared.median);
    } else if constexpr (kPhase == kTell) {
      if (at.thread == 0) tellMedian(at, shared, &facts[at.x]);
      if (is_last && at.thread < kRegions * kLanes) sumRegion(at, shared);
    } else if (is_last) {
      for (int i = at.thread; i < kRegions * kRegionSums; i += kThreads)
        tellRegion(i / kRegionSums, i % kRegionSums, shared, &facts[at.x]);
    }
  }

 private:
  SOFTSCOPE_HD PairResidual residualAt(const Place& at, int i, const PoseRows& pose) const {
    return pairResidual(pairs[i], static_cast<PairPlace>(at.x), inputs->rig, pose);
  }
  SOFTSCOPE_HD const PoseRows& bestOf(const Place& at) const { return betterEnd(ends + 2 * at.x); }
  SOFTSCOPE_HD const PoseRows& oldOf(const Place& at) const {
    const bool is_now = static_cast<PairPlace>(at.x) == PairPlace::kNow;
    return inputs->starts[is_now ? kOldPose : kPoseBefore];
  }
  SOFTSCOPE_HD void lookAt(const Place& at, Shared& shared, Local& local) const {
    int explained = 0;
    for (int k = 0; k < kPairsEach; ++k) {
      local.keys[k] = PoseMedian::kNoKey;
      const int i = k * kThreads + at.thread;
      if (i >= inputs->pairs) continue;
      const PairResidual here = residualAt(at, i, bestOf(at));
      const PairResidual there = residualAt(at, i, oldOf(at));
      const double squared = here.squared(), old_squared = there.squared();
      if (here.usable && there.usable) {
        double between = 0;
        for (int c = 0; c < 3; ++c)
          between += (here.value[c] - there.value[c]) * (here.value[c] - there.value[c]);
        const double of[kMedians] = {between, squared, old_squared};
        local.keys[k] = PoseMedian::keyOf(std::sqrt(of[at.repeat]));
      }
      if (at.repeat < kMedians - 1) continue;
      const int region = here.usable ? inputs->regions.of(pairs[i].live_px) : kNoRegion;
      shared.regions[i] = static_cast<std::int8_t>(region);
      if (here.usable) explained += squared < kCostScaleSq ? 1 : 0;
    }
    if (explained > 0) atomicPlus(&shared.explained, explained);
  }

  SOFTSCOPE_HD void tellMedian(const Place& at, Shared& shared, PoseFacts* out) const {
    const double median = shared.median.count > 0 ? shared.median.value() : 0;
    out->medians[at.repeat] = median;
    out->compared = shared.median.count;
    if (at.repeat == kLengths)
      shared.scale_sq = robustScaleSq(median * median, inputs->scale_of_median);
    if (at.repeat < kMedians - 1) return;
    out->best = bestOf(at);
    out->explained = shared.explained;
  }
  /// Every lane of a region has every kLanes-th pair.
  SOFTSCOPE_HD void sumRegion(const Place& at, Shared& shared) const {
    const int region = at.thread / kLanes, lane = at.thread % kLanes;
    double sums[kPoseSums] = {}, gain = 0;
    int count = 0, both = 0;
    for (int i = lane; i < inputs->pairs; i += kLanes) {
      if (shared.regions[i] != region) continue;
      ++count;
      const PairResidual here = residualAt(at, i, bestOf(at)), there = residualAt(at, i, oldOf(at));
      const double squared = here.squared();
      addToSums(here, pairCurvature(squared, shared.scale_sq), pairWeight(squared, shared.scale_sq),
                sums);
      if (!there.usable) continue;
      ++both;
      gain += pairCost(there.squared()) - pairCost(squared);
    }
    for (int j = 0; j < kPoseSums; ++j) shared.lanes[j][at.thread] = sums[j];
    shared.lanes[kGain][at.thread] = gain;
    atomicPlus(&shared.score_counts[region], count);
    atomicPlus(&shared.counts[region], both);
  }
  SOFTSCOPE_HD static void tellRegion(int region, int what, const Shared& shared, PoseFacts* out) {
    double sum = 0;
    for (int lane = 0; lane < kLanes; ++lane) sum += shared.lanes[what][region * kLanes + lane];
    if (what < kNormal) {
      out->normals[region][what] = sum;
    } else if (what < kGain) {
      out->scores[region][what - kNormal] = -sum;
    } else {
      out->gains[region] = sum;
      out->score_counts[region] = shared.score_counts[region];
      out->counts[region] = shared.counts[region];
    }
  }
};

}  // namespace softscope::cuda
