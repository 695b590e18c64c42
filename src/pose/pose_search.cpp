#include "pose/pose_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/median.h"
#include "core/parallel.h"

namespace softscope {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kPairsPerTask = 256;

struct Residual {
  Eigen::Vector3d value;
  Eigen::Matrix<double, 3, 6> slope;
  bool usable = false;
};

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Vector6d& twist) {
  const Eigen::Vector3d turn = twist.head<3>();
  Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  by.translation() = twist.tail<3>();
  return by * pose;
}

/// Normal equations of weighted residuals.
struct PoseEquations {
  Matrix6d normal = Matrix6d::Zero();  // its lower triangle
  Vector6d right = Vector6d::Zero();

  void add(const Residual& residual, double weight) {
    const Eigen::Matrix<double, 3, 6>& slope = residual.slope;
    const Eigen::Vector3d& value = residual.value;
    double weighted[3][6];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 6; ++i) weighted[k][i] = weight * slope(k, i);
    for (int j = 0; j < 6; ++j)
      for (int i = j; i < 6; ++i)
        normal(i, j) += weighted[0][i] * slope(0, j) + weighted[1][i] * slope(1, j) +
                        weighted[2][i] * slope(2, j);
    for (int i = 0; i < 6; ++i)
      right[i] += weighted[0][i] * value[0] + weighted[1][i] * value[1] + weighted[2][i] * value[2];
  }
};

/// The pairs, evaluated at any pose.
class Pairs {
 public:
  Pairs(const PoseQuestion& question, PairPlace place) : question_(question), place_(place) {}

  /// The better result of the searches from both poses.
  Eigen::Isometry3d search(const Eigen::Isometry3d& left_from_world,
                           const Eigen::Isometry3d& other_left_from_world) const {
    Eigen::Isometry3d one, other;
    parallelInvoke([&] { one = searchFrom(left_from_world); },
                   [&] { other = searchFrom(other_left_from_world); });
    return costAt(other) < costAt(one) ? other : one;
  }

  PoseFindings findingsAt(const Eigen::Isometry3d& best, const Eigen::Isometry3d& old) const {
    PoseFindings found;
    found.best = best;
    compare(rowsOf(best), rowsOf(old), &found);
    const double scale_sq = robustScaleSq(found.length * found.length, question_.scale_of_median);
    differentiate(rowsOf(best), scale_sq, &found);
    return found;
  }

 private:
  std::size_t regionOf(const SeenPair& pair) const {
    return static_cast<std::size_t>(question_.regions.of(pair.live_px));
  }

  /// Medians and gains.
  void compare(const PoseRows& best, const PoseRows& old, PoseFindings* found) const {
    std::vector<double> shifts, lengths, old_lengths;
    for (const SeenPair& pair : question_.pairs) {
      const Residual here = residualAt(pair, best);
      if (!here.usable) continue;
      found->explained += here.value.squaredNorm() < kCostScaleSq;
      const Residual there = residualAt(pair, old);
      if (!there.usable) continue;
      shifts.push_back((here.value - there.value).norm());
      lengths.push_back(here.value.norm());
      old_lengths.push_back(there.value.norm());
      found->gains[regionOf(pair)] +=
          pairCost(there.value.squaredNorm()) - pairCost(here.value.squaredNorm());
      ++found->counts[regionOf(pair)];
    }
    found->shift = medianOf(std::move(shifts));
    found->length = medianOf(std::move(lengths));
    found->old_length = medianOf(std::move(old_lengths));
  }

  void differentiate(const PoseRows& best, double scale_sq, PoseFindings* found) const {
    found->normals.fill(Matrix6d::Zero());
    found->scores.fill(Vector6d::Zero());
    for (const SeenPair& pair : question_.pairs) {
      const Residual residual = residualAt(pair, best);
      if (!residual.usable) continue;
      const double squared = residual.value.squaredNorm();
      const Eigen::Matrix<double, 6, 3> transposed = residual.slope.transpose();
      const std::size_t region = regionOf(pair);
      found->normals[region] += pairCurvature(squared, scale_sq) * transposed * residual.slope;
      found->scores[region] += pairWeight(squared, scale_sq) * transposed * residual.value;
      ++found->score_counts[region];
    }
  }

  Residual residualAt(const SeenPair& pair, const PoseRows& left_from_world) const {
    const PairResidual plain = pairResidual(pair, place_, question_.rig, left_from_world);
    Residual residual;
    residual.usable = plain.usable;
    residual.value = Eigen::Map<const Eigen::Vector3d>(plain.value);
    residual.slope =
        Eigen::Map<const Eigen::Matrix<double, 3, 6, Eigen::RowMajor>>(&plain.slope[0][0]);
    return residual;
  }

  std::vector<Residual> residualsAt(const Eigen::Isometry3d& left_from_world) const {
    const PoseRows rows = rowsOf(left_from_world);
    std::vector<Residual> residuals(question_.pairs.size());
    parallelRanges(static_cast<int>(residuals.size()), kPairsPerTask, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        residuals[i] = residualAt(question_.pairs[i], rows);
      }
    });
    const auto unusable = [](const Residual& residual) { return !residual.usable; };
    residuals.erase(std::remove_if(residuals.begin(), residuals.end(), unusable), residuals.end());
    return residuals;
  }

  /// Mean robust cost per pair, 0 to 1: docs/energy.md (28).
  double costAt(const Eigen::Isometry3d& left_from_world) const {
    const std::vector<Residual> residuals = residualsAt(left_from_world);
    double sum = 0;
    for (const Residual& residual : residuals) sum += pairCost(residual.value.squaredNorm());
    return residuals.empty() ? 1 : sum / static_cast<double>(residuals.size());
  }

  Eigen::Isometry3d searchFrom(Eigen::Isometry3d left_from_world) const {
    for (int i = 0; i < question_.iterations; ++i) {
      const Vector6d twist = stepFrom(left_from_world);
      left_from_world = moved(left_from_world, twist);
      if (twist.tail<3>().norm() + PoseSearch::kTypicalDepthMm * twist.head<3>().norm() <
          PoseSearch::kConvergedMm)
        break;
    }
    return left_from_world;
  }

  Vector6d stepFrom(const Eigen::Isometry3d& left_from_world) const {
    const std::vector<Residual> residuals = residualsAt(left_from_world);
    if (residuals.size() < 3) return Vector6d::Zero();
    std::vector<double> squares;
    squares.reserve(residuals.size());
    for (const Residual& residual : residuals) squares.push_back(residual.value.squaredNorm());
    const double scale_sq = robustScaleSq(medianOf(std::move(squares)), question_.scale_of_median);
    PoseEquations equations;
    for (const Residual& residual : residuals)
      equations.add(residual, pairWeight(residual.value.squaredNorm(), scale_sq));
    const Vector6d twist = equations.normal.ldlt().solve(-equations.right);
    return twist.allFinite() ? twist : Vector6d(Vector6d::Zero());
  }

  const PoseQuestion& question_;
  const PairPlace place_;
};

}  // namespace

PoseRows rowsOf(const Eigen::Isometry3d& left_from_world) {
  PoseRows rows;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) rows.at[i][j] = left_from_world(i, j);
  return rows;
}

PoseAnswer CpuPoseSearch::answer(const PoseQuestion& question) {
  const Pairs now(question, PairPlace::kNow), since(question, PairPlace::kSince);
  PoseAnswer answer;
  parallelInvoke(
      [&] { answer.now = now.findingsAt(now.search(question.fitted, question.old), question.old); },
      [&] {
        answer.since =
            since.findingsAt(since.search(question.fitted, question.before), question.before);
      });
  return answer;
}

}  // namespace softscope
