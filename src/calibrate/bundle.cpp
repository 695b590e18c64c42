#include "calibrate/bundle.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using PoseMatrix = Eigen::Matrix<double, 6, 6>;
using Mixed = Eigen::Matrix<double, kRigUnknowns, 6>;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d turnBy(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

/// Applies a small rotation from the left, then a translation.
void movePose(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift, Eigen::Isometry3d* pose) {
  pose->linear() = turnBy(turn) * pose->linear();
  pose->linear() = Eigen::Quaterniond(pose->linear()).normalized().toRotationMatrix();
  pose->translation() += shift;
}

void addToCamera(const Eigen::Matrix<double, kCameraUnknowns, 1>& step, RawCamera* camera) {
  camera->pinhole.fx_px += step[0];
  camera->pinhole.fy_px += step[1];
  camera->pinhole.cx_px += step[2];
  camera->pinhole.cy_px += step[3];
  for (std::size_t k = 0; k < 5; ++k)
    camera->distortion.coefficients[k] += step[4 + static_cast<int>(k)];
}

/// Normal equations with separate blocks per view.
struct Normal {
  RigMatrix rig = RigMatrix::Zero();
  RigVector rig_side = RigVector::Zero();
  std::vector<PoseMatrix> pose;
  std::vector<Mixed> mixed;
  std::vector<Pose6> pose_side;
  double squares = 0;
  int observations = 0;
};

void addView(const BundleState& state, const BundleView& view, Normal* normal) {
  PoseMatrix pose = PoseMatrix::Zero();
  Mixed mixed = Mixed::Zero();
  Pose6 side = Pose6::Zero();
  for (const BundlePoint& point : view.points) {
    const Eigen::Vector3d turned = view.left_from_board.linear() * point.board_mm;
    const RigProjection seen =
        projectThroughRig(state, turned + view.left_from_board.translation(), point.is_right);
    const Eigen::Vector2d residual = point.pixel - seen.pixel;
    Eigen::Matrix<double, 2, 6> by_pose;
    by_pose.leftCols<3>() = -seen.by_left_point * cross(turned);
    by_pose.rightCols<3>() = seen.by_left_point;
    normal->rig += seen.by_rig.transpose() * seen.by_rig;
    normal->rig_side += seen.by_rig.transpose() * residual;
    pose += by_pose.transpose() * by_pose;
    mixed += seen.by_rig.transpose() * by_pose;
    side += by_pose.transpose() * residual;
    normal->squares += residual.squaredNorm();
    normal->observations += 2;
  }
  normal->pose.push_back(pose);
  normal->mixed.push_back(mixed);
  normal->pose_side.push_back(side);
}

Normal normalOf(const BundleState& state) {
  Normal normal;
  for (const BundleView& view : state.views) addView(state, view, &normal);
  return normal;
}

double squaresOf(const BundleState& state) {
  double squares = 0;
  for (const BundleView& view : state.views)
    for (const Eigen::Vector2d& residual : residualsOf(state, view))
      squares += residual.squaredNorm();
  return squares;
}

/// 1 for free unknowns.
RigVector freeUnknowns(const BundleOptions& options) {
  RigVector is_free = RigVector::Ones();
  for (const int camera : {0, kCameraUnknowns})
    for (int k = options.lens_coefficients; k < 5; ++k) is_free[camera + 4 + k] = 0;
  return is_free;
}

/// Replaces rows and columns of fixed unknowns by those of the identity.
RigMatrix restricted(const RigMatrix& matrix, const RigVector& is_free) {
  RigMatrix out = is_free.asDiagonal() * matrix * is_free.asDiagonal();
  for (int i = 0; i < kRigUnknowns; ++i)
    if (is_free[i] == 0) out(i, i) = 1;
  return out;
}

/// Equations of the shared unknowns without the poses, with `damping` times each diagonal added.
struct Reduced {
  RigMatrix matrix;
  RigVector side;
};
Reduced reduce(const Normal& normal, double damping, const RigVector& is_free) {
  Reduced reduced{normal.rig, normal.rig_side};
  reduced.matrix.diagonal() *= 1 + damping;
  for (std::size_t i = 0; i < normal.pose.size(); ++i) {
    PoseMatrix pose = normal.pose[i];
    pose.diagonal() *= 1 + damping;
    const Eigen::LDLT<PoseMatrix> solver(pose);
    reduced.matrix -= normal.mixed[i] * solver.solve(normal.mixed[i].transpose());
    reduced.side -= normal.mixed[i] * solver.solve(normal.pose_side[i]);
  }
  reduced.matrix = restricted(reduced.matrix, is_free);
  reduced.side = reduced.side.cwiseProduct(is_free);
  return reduced;
}

/// For a symmetric matrix of unknowns with different units.
RigMatrix scaledInverse(const RigMatrix& matrix) {
  const RigVector scale = matrix.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::LDLT<RigMatrix> solver(scale.asDiagonal() * matrix * scale.asDiagonal());
  const RigVector pivots = solver.vectorD();
  if (solver.info() != Eigen::Success || !(pivots.minCoeff() > 1e-13))
    throw InputError(
        "the views do not determine the cameras: the poses of the board are too similar. Record it "
        "tilted in several directions, at several distances and in all parts of the image.");
  const RigMatrix inverse = solver.solve(RigMatrix::Identity());
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

BundleState stepped(const BundleState& state, const Normal& normal, double damping,
                    const RigVector& is_free) {
  const Reduced reduced = reduce(normal, damping, is_free);
  const RigVector step = scaledInverse(reduced.matrix) * reduced.side;
  BundleState next = state;
  addToCamera(step.head<kCameraUnknowns>(), &next.left);
  addToCamera(step.segment<kCameraUnknowns>(kCameraUnknowns), &next.right);
  movePose(step.segment<3>(2 * kCameraUnknowns), step.tail<3>(), &next.right_from_left);
  for (std::size_t i = 0; i < normal.pose.size(); ++i) {
    PoseMatrix pose = normal.pose[i];
    pose.diagonal() *= 1 + damping;
    const Pose6 move = Eigen::LDLT<PoseMatrix>(pose).solve(normal.pose_side[i] -
                                                           normal.mixed[i].transpose() * step);
    movePose(move.head<3>(), move.tail<3>(), &next.views[i].left_from_board);
  }
  return next;
}

}  // namespace

void BundleOptions::validate() const {
  require(lens_coefficients == 0 || lens_coefficients == 2 || lens_coefficients == 4 ||
              lens_coefficients == 5,
          "`lens_coefficients=`", lens_coefficients, "must be 0, 2, 4 or 5");
  require(most_iterations >= 1, "most_iterations", most_iterations, "must be 1 or more");
}

Eigen::Vector2d projectWithLens(const RawCamera& camera, const Eigen::Vector3d& point_mm,
                                Eigen::Matrix<double, 2, 3>* by_point,
                                Eigen::Matrix<double, 2, kCameraUnknowns>* by_camera) {
  const PinholeCamera& pinhole = camera.pinhole;
  const auto& c = camera.distortion.coefficients;
  const double k1 = c[0], k2 = c[1], p1 = c[2], p2 = c[3], k3 = c[4];
  const double x = point_mm.x() / point_mm.z(), y = point_mm.y() / point_mm.z();
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial = 1 + k1 * r2 + k2 * r4 + k3 * r6;
  const double slope = k1 + 2 * k2 * r2 + 3 * k3 * r4;  // derivative of `radial` with respect to r2
  const double xd = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double yd = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  const double fx = pinhole.fx_px, fy = pinhole.fy_px;
  if (by_point) {
    Eigen::Matrix2d bend;  // derivative of (xd, yd) with respect to (x, y)
    bend << radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x,
        2 * x * y * slope + 2 * p1 * x + 2 * p2 * y, 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
        radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x;
    Eigen::Matrix<double, 2, 3> flatten;  // derivative of (x, y) with respect to the point
    flatten << 1, 0, -x, 0, 1, -y;
    *by_point = Eigen::Vector2d(fx, fy).asDiagonal() * bend * flatten / point_mm.z();
  }
  if (by_camera)
    *by_camera << xd, 0, 1, 0, fx * x * r2, fx * x * r4, fx * 2 * x * y, fx * (r2 + 2 * x * x),
        fx * x * r6, 0, yd, 0, 1, fy * y * r2, fy * y * r4, fy * (r2 + 2 * y * y), fy * 2 * x * y,
        fy * y * r6;
  return {fx * xd + pinhole.cx_px, fy * yd + pinhole.cy_px};
}

RigProjection projectThroughRig(const BundleState& state, const Eigen::Vector3d& point_left_mm,
                                bool is_right) {
  RigProjection seen;
  seen.by_rig.setZero();
  Eigen::Matrix<double, 2, kCameraUnknowns> by_camera;
  Eigen::Matrix<double, 2, 3> by_point;
  if (!is_right) {
    seen.pixel = projectWithLens(state.left, point_left_mm, &by_point, &by_camera);
    seen.by_rig.leftCols<kCameraUnknowns>() = by_camera;
    seen.by_left_point = by_point;
    return seen;
  }
  const Eigen::Vector3d turned = state.right_from_left.linear() * point_left_mm;
  seen.pixel = projectWithLens(state.right, turned + state.right_from_left.translation(), &by_point,
                               &by_camera);
  seen.by_rig.middleCols<kCameraUnknowns>(kCameraUnknowns) = by_camera;
  seen.by_rig.middleCols<3>(2 * kCameraUnknowns) = -by_point * cross(turned);
  seen.by_rig.rightCols<3>() = by_point;
  seen.by_left_point = by_point * state.right_from_left.linear();
  return seen;
}

std::vector<Eigen::Vector2d> residualsOf(const BundleState& state, const BundleView& view) {
  std::vector<Eigen::Vector2d> residuals;
  for (const BundlePoint& point : view.points) {
    Eigen::Vector3d p = view.left_from_board * point.board_mm;
    if (point.is_right) p = state.right_from_left * p;
    residuals.push_back(point.pixel - projectWithLens(point.is_right ? state.right : state.left, p,
                                                      nullptr, nullptr));
  }
  return residuals;
}

BundleSummary adjustBundle(const BundleOptions& options, BundleState* state) {
  options.validate();
  const RigVector is_free = freeUnknowns(options);
  BundleSummary summary;
  Normal normal = normalOf(*state);
  double damping = 1e-4;
  while (!summary.converged && summary.iterations < options.most_iterations && damping < 1e8) {
    ++summary.iterations;
    const BundleState next = stepped(*state, normal, damping, is_free);
    const double squares = squaresOf(next);
    if (!(squares <= normal.squares)) {
      damping *= 10;
      continue;
    }
    summary.converged = normal.squares - squares <= 1e-10 * normal.squares;
    *state = next;
    normal = normalOf(*state);
    damping = std::max(1e-12, damping / 10);
  }
  if (damping >= 1e8) summary.converged = true;  // no step reduces the residual
  const int unknowns = static_cast<int>(is_free.sum()) + 6 * static_cast<int>(state->views.size());
  if (normal.observations <= unknowns)
    throw InputError("the views hold " + std::to_string(normal.observations) +
                     " coordinates of corners, but there are " + std::to_string(unknowns) +
                     " unknowns; film more views of the board.");
  summary.rms_px = std::sqrt(2 * normal.squares / normal.observations);
  summary.sigma_px = std::sqrt(normal.squares / (normal.observations - unknowns));
  const RigMatrix inverse = scaledInverse(reduce(normal, 0, is_free).matrix);
  summary.covariance =
      summary.sigma_px * summary.sigma_px * (is_free.asDiagonal() * inverse * is_free.asDiagonal());
  return summary;
}

}  // namespace softscope
