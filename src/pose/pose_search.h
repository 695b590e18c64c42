// src/pose/pose_search.h: robust search of the pose over matched pairs.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <vector>

#include "pose/pair_residual.h"

namespace softscope {

PoseRows rowsOf(const Eigen::Isometry3d& left_from_world);

/// All poses are left camera from world.
struct PoseQuestion {
  std::vector<SeenPair> pairs;
  RectifiedRig rig;
  PairRegions regions{};
  Eigen::Isometry3d fitted, old;  // where the search with the places of now begins
  Eigen::Isometry3d before;       // and, beside the end of that, with the places since
  int iterations = 0;
};

/// Of the pairs' places of now, or since.
struct PoseFindings {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  // Medians over the pairs that both poses see, standard errors; NaN without any.
  double shift = kNan;                   // between what `best` and the old pose predict
  double length = kNan;                  // of the residuals at `best`
  double old_length = kNan;              // and at the old pose
  std::array<double, kRegions> gains{};  // of cost over the old pose, by region
  std::array<int, kRegions> counts{};    // of pairs in it
  int explained = 0;  // pairs that `best` puts where they were found, to three standard errors
  // At `best`: weighted normal matrix, gradients of the regions, and their pairs.
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  std::array<Eigen::Matrix<double, 6, 1>, kRegions> scores{};
  std::array<int, kRegions> score_counts{};
};

struct PoseAnswer {
  PoseFindings now, since;
};

/// Iteratively reweighted Gauss-Newton over the pose from both starts, the end with the least cost
/// counts: docs/energy.md (26) to (28).
class PoseSearch {
 public:
  virtual ~PoseSearch() = default;
  virtual PoseAnswer answer(const PoseQuestion& question) = 0;

  static constexpr double kConvergedMm = 1e-4;
  static constexpr double kTypicalDepthMm = 50;  // turns a rotation into a shift, to judge that
};

/// On the processor's cores.
class CpuPoseSearch final : public PoseSearch {
 public:
  PoseAnswer answer(const PoseQuestion& question) override;
};

}  // namespace softscope
