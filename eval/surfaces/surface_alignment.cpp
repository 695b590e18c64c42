// eval/surfaces/surface_alignment.cpp: iteration of pairing, trimming and Gauss-Newton steps.
#include "eval/surfaces/surface_alignment.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/alignment/rigid_alignment.h"

namespace softscope {
namespace {

constexpr std::size_t kFewestPairs = 6;   // number of degrees of freedom of a rigid transform
constexpr double kFreeEigenvalue = 1e-9;  // relative to the largest: undetermined direction

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Pair {
  Eigen::Vector3d point_mm;    // transformed by the current pose
  Eigen::Vector3d surface_mm;  // closest point on the surface
  Eigen::Vector3d normal;      // of the closest triangle
  double distance_mm;
};

/// Small rigid motion of the transformed points.
struct Step {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  int free_directions = 0;
};

std::vector<Pair> findPairs(const std::vector<Eigen::Vector3f>& points_mm,
                            const TriangleTree& surface, const AlignmentOptions& options,
                            const Eigen::Isometry3d& pose) {
  const std::vector<ClosestPoint> closest = surface.closestPoints(movePoints(pose, points_mm));
  std::vector<Pair> pairs;
  pairs.reserve(points_mm.size());
  for (std::size_t i = 0; i < points_mm.size(); ++i) {
    const ClosestPoint& c = closest[i];
    if (c.triangle < 0 || (c.on_border && options.leave_out_border)) continue;
    const Eigen::Vector3d moved_mm = pose * points_mm[i].cast<double>();
    pairs.push_back(
        {moved_mm, c.point_mm, surface.faceNormal(c.triangle), (moved_mm - c.point_mm).norm()});
  }
  return pairs;
}

void trim(std::vector<Pair>& pairs, double share) {
  const auto kept =
      static_cast<std::ptrdiff_t>(std::ceil((1 - share) * static_cast<double>(pairs.size())));
  std::nth_element(pairs.begin(), pairs.begin() + kept, pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance_mm < b.distance_mm; });
  pairs.resize(static_cast<std::size_t>(kept));
}

/// Centre and extent of the points.
struct Spread {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0;  // root mean square, positive
};

Spread spreadOf(const std::vector<Pair>& pairs) {
  Spread spread;
  for (const Pair& pair : pairs) spread.centre_mm += pair.point_mm;
  spread.centre_mm /= static_cast<double>(pairs.size());
  double squares = 0;
  for (const Pair& pair : pairs) squares += (pair.point_mm - spread.centre_mm).squaredNorm();
  spread.radius_mm = std::max(std::sqrt(squares / static_cast<double>(pairs.size())), 1e-12);
  return spread;
}

/// Gauss-Newton on normal . (point - surface): rotations about the centre are scaled by
/// the radius, so all six unknowns are lengths. Undetermined directions remain zero.
Step planeStep(const std::vector<Pair>& pairs) {
  const Spread spread = spreadOf(pairs);
  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();
  for (const Pair& pair : pairs) {
    Vector6 row;
    row << ((pair.point_mm - spread.centre_mm) / spread.radius_mm).cross(pair.normal), pair.normal;
    normal_matrix += row * row.transpose();
    right_side -= row * pair.normal.dot(pair.point_mm - pair.surface_mm);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> modes(normal_matrix);
  Step step;
  Vector6 unknowns = Vector6::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector6 mode = modes.eigenvectors().col(i);
    if (modes.eigenvalues()[i] <= kFreeEigenvalue * modes.eigenvalues()[5])
      ++step.free_directions;
    else
      unknowns += mode * (mode.dot(right_side) / modes.eigenvalues()[i]);
  }
  const Eigen::Vector3d turn = unknowns.head<3>() / spread.radius_mm;
  if (turn.norm() > 0)
    step.motion.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  step.motion.translation() =
      spread.centre_mm + unknowns.tail<3>() - step.motion.linear() * spread.centre_mm;
  return step;
}

Step pointStep(const std::vector<Pair>& pairs) {
  std::vector<Eigen::Vector3d> points_mm, surface_mm;
  for (const Pair& pair : pairs) {
    points_mm.push_back(pair.point_mm);
    surface_mm.push_back(pair.surface_mm);
  }
  const RigidFit fit = fitRigid(points_mm, surface_mm);
  return {fit.target_from_source, fit.unique ? 0 : 1};
}

double rootMeanSquareMotion_mm(const Eigen::Isometry3d& motion, const std::vector<Pair>& pairs) {
  double squares = 0;
  for (const Pair& pair : pairs) squares += (motion * pair.point_mm - pair.point_mm).squaredNorm();
  return std::sqrt(squares / static_cast<double>(pairs.size()));
}

/// Computes everything except the errors.
void iterate(const std::vector<Eigen::Vector3f>& points_mm, const TriangleTree& surface,
             const AlignmentOptions& options, SurfaceAlignment& result) {
  Eigen::Isometry3d& pose = result.surface_from_points;
  while (result.iterations < options.max_iterations && !result.converged()) {
    std::vector<Pair> pairs = findPairs(points_mm, surface, options, pose);
    trim(pairs, options.trimmed_share);
    result.pair_count = pairs.size();
    if (pairs.size() < kFewestPairs) {
      result.stop = AlignmentStop::kTooFewPairs;
      return;
    }
    const Step step =
        options.metric == AlignmentMetric::kPointToPlane ? planeStep(pairs) : pointStep(pairs);
    pose = step.motion * pose;
    ++result.iterations;
    result.free_directions = step.free_directions;
    if (rootMeanSquareMotion_mm(step.motion, pairs) < options.converged_step_mm)
      result.stop = AlignmentStop::kConverged;
  }
}

}  // namespace

void AlignmentOptions::validate() const {
  require(max_iterations >= 1, "max_iterations", max_iterations, "must be 1 or more");
  require(trimmed_share >= 0 && trimmed_share < 1, "trimmed_share", trimmed_share,
          "must be from 0 to below 1");
  require(converged_step_mm > 0, "converged_step_mm", converged_step_mm, "must be above 0");
}

std::vector<Eigen::Vector3f> movePoints(const Eigen::Isometry3d& to_from_points,
                                        const std::vector<Eigen::Vector3f>& points_mm) {
  std::vector<Eigen::Vector3f> moved_mm;
  moved_mm.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm)
    moved_mm.push_back((to_from_points * p.cast<double>()).cast<float>());
  return moved_mm;
}

SurfaceAlignment alignToSurface(const std::vector<Eigen::Vector3f>& points_mm,
                                const TriangleTree& surface, const AlignmentOptions& options,
                                const Eigen::Isometry3d& surface_from_points_start) {
  options.validate();
  const auto errorsAt = [&](const Eigen::Isometry3d& pose) {
    return surfaceErrors(surface.closestPoints(movePoints(pose, points_mm)));
  };
  SurfaceAlignment result;
  result.surface_from_points = surface_from_points_start;
  result.before = errorsAt(surface_from_points_start);
  iterate(points_mm, surface, options, result);
  result.after = errorsAt(result.surface_from_points);
  return result;
}

}  // namespace softscope
