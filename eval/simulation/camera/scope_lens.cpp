// eval/simulation/camera/scope_lens.cpp: terms of Brown's model with derivatives.
#include "eval/simulation/camera/scope_lens.h"

#include <Eigen/LU>

namespace softscope {
namespace {

constexpr int kNewtonSteps = 8;  // quadratic convergence; 4 are enough for common lenses
constexpr int kRimSteps = 16;    // samples per side in the check of the lens
constexpr double kRim = 0.05;    // margin around the image, as a share of it

/// Distorted direction (x, y, 1), with its derivatives.
struct Bent {
  Eigen::Vector2d place;
  Eigen::Matrix2d slope;
};

Bent bend(const LensDistortion& lens, const Eigen::Vector2d& at) {
  const double k1 = lens.coefficients[0], k2 = lens.coefficients[1], p1 = lens.coefficients[2],
               p2 = lens.coefficients[3], k3 = lens.coefficients[4];
  const double x = at.x(), y = at.y(), r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double growth = k1 + r2 * (2 * k2 + r2 * 3 * k3);  // derivative of radial by r2
  Bent bent;
  bent.place = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  const double across = 2 * x * y * growth + 2 * p1 * x + 2 * p2 * y;
  bent.slope << radial + 2 * x * x * growth + 2 * p1 * y + 6 * p2 * x, across, across,
      radial + 2 * y * y * growth + 6 * p1 * y + 2 * p2 * x;
  return bent;
}

}  // namespace

Eigen::Vector2d ScopeLens::project(const Eigen::Vector3d& point_mm) const {
  if (distortion.isZero()) return projectPoint<double>(camera, point_mm);
  const Eigen::Vector2d place = bend(distortion, point_mm.head<2>() / point_mm.z()).place;
  return {camera.fx_px * place.x() + camera.cx_px, camera.fy_px * place.y() + camera.cy_px};
}

Eigen::Vector3d ScopeLens::ray(double u_px, double v_px) const {
  const Eigen::Vector3d straight = liftPixel<double>(camera, u_px, v_px, 1.0);
  if (distortion.isZero()) return straight;
  const Eigen::Vector2d wanted = straight.head<2>();
  Eigen::Vector2d at = wanted;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Bent bent = bend(distortion, at);
    const Eigen::Vector2d move = bent.slope.inverse() * (wanted - bent.place);
    at += move;
    if (!(move.squaredNorm() > 1e-24)) break;
  }
  return {at.x(), at.y(), 1};
}

bool ScopeLens::invertible() const {
  for (int j = 0; j <= kRimSteps; ++j)
    for (int i = 0; i <= kRimSteps; ++i) {
      const double u = camera.width_px * ((1 + 2 * kRim) * i / kRimSteps - kRim);
      const double v = camera.height_px * ((1 + 2 * kRim) * j / kRimSteps - kRim);
      const Eigen::Vector3d direction = ray(u, v);
      if (!((project(direction) - Eigen::Vector2d(u, v)).norm() < 1e-6)) return false;
      if (!(bend(distortion, direction.head<2>()).slope.determinant() > 0.05)) return false;
    }
  return true;
}

}  // namespace softscope
