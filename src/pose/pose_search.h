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
  Eigen::Isometry3d fitted;    // start with either positions
  Eigen::Isometry3d old;       // start with positions of the last frame
  Eigen::Isometry3d before;    // start with positions since the reference
  double scale_of_median = 0;  // robust scale of a pair over the median residual
  int iterations = 0;
};

/// With the positions of the last frame, or since the reference.
struct PoseFindings {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

  Eigen::Isometry3d best = Eigen::Isometry3d::Identity();
  // Medians over the pairs visible at both poses, standard errors; NaN without any.
  double shift = kNan;                   // between the predictions of `best` and the old pose
  double length = kNan;                  // of the residuals at `best`
  double old_length = kNan;              // and at the old pose
  std::array<double, kRegions> gains{};  // of cost over the old pose, by region
  std::array<int, kRegions> counts{};    // of pairs in it
  int explained = 0;                     // pairs that `best` predicts to three standard errors
  // Of the robust cost at `best`, by region: second derivatives, gradients, and pairs.
  std::array<Eigen::Matrix<double, 6, 6>, kRegions> normals{};
  std::array<Eigen::Matrix<double, 6, 1>, kRegions> scores{};
  std::array<int, kRegions> score_counts{};
};

struct PoseAnswer {
  PoseFindings now, since;
};

/// Iteratively reweighted Gauss-Newton over the pose from both starts;
/// the result with the lower cost counts: docs/energy.md (26) to (28).
class PoseSearch {
 public:
  virtual ~PoseSearch() = default;
  virtual PoseAnswer answer(const PoseQuestion& question) = 0;

  static constexpr double kConvergedMm = 1e-4;
  static constexpr double kTypicalDepthMm = 50;  // converts a rotation to a shift, to compare it
};

/// On the CPU.
class CpuPoseSearch final : public PoseSearch {
 public:
  PoseAnswer answer(const PoseQuestion& question) override;
};

}  // namespace softscope
