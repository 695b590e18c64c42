// src/calibrate/corner_fit.cpp: Levenberg-Marquardt over nine unknowns.
#include "calibrate/corner_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

namespace softscope {
namespace {

// px, py, angles of both normals, log of the blur, contrast, level and its slopes.
using CornerUnknowns = Eigen::Matrix<double, 9, 1>;
using CornerMatrix = Eigen::Matrix<double, 9, 9>;
enum Unknown { kU, kV, kAngle1, kAngle2, kLogBlur, kContrast, kLevel, kSlopeU, kSlopeV };

constexpr int kMostSteps = 30;
constexpr double kFoundPx = 1e-4;       // termination: smaller step of the corner
constexpr double kLargestMovePx = 1.5;  // from the start
constexpr double kLeastBlurPx = 0.2, kLargestBlurPx = 6;
constexpr double kLeastContrast = 5;  // in grey levels, on either side

struct LeastSquares {
  CornerMatrix matrix = CornerMatrix::Zero();
  CornerUnknowns gradient = CornerUnknowns::Zero();
  double squares = 0;
};

/// erf(x / √2) and its derivative.
struct Edge {
  explicit Edge(double x)
      : value(std::erf(x * M_SQRT1_2)), slope(M_2_SQRTPI * M_SQRT1_2 * std::exp(-x * x / 2)) {}
  double value, slope;
};

/// Pixels of the disc around `centre`; false if it exceeds the image.
template <class Take>
bool forDisc(const GrayImage& image, const Eigen::Vector2d& centre, int reach_px, Take take) {
  const int u0 = static_cast<int>(std::lround(centre.x()));
  const int v0 = static_cast<int>(std::lround(centre.y()));
  if (!image.contains(u0 - reach_px, v0 - reach_px) ||
      !image.contains(u0 + reach_px, v0 + reach_px))
    return false;
  const int reach_2 = reach_px * reach_px + reach_px;  // (reach + 1/2)²
  for (int v = -reach_px; v <= reach_px; ++v)
    for (int u = -reach_px; u <= reach_px; ++u)
      if (u * u + v * v <= reach_2) take(u0 + u, v0 + v, image.at(u0 + u, v0 + v));
  return true;
}

/// Predicted grey level with its derivatives.
double predicted(const CornerUnknowns& x, double u, double v, CornerUnknowns* slopes) {
  const double du = u - x[kU], dv = v - x[kV], blur = std::exp(x[kLogBlur]);
  const double c1 = std::cos(x[kAngle1]), s1 = std::sin(x[kAngle1]);
  const double c2 = std::cos(x[kAngle2]), s2 = std::sin(x[kAngle2]);
  const double t1 = (c1 * du + s1 * dv) / blur, t2 = (c2 * du + s2 * dv) / blur;
  const Edge one(t1), two(t2);
  const double by_1 = x[kContrast] * one.slope * two.value;
  const double by_2 = x[kContrast] * one.value * two.slope;
  *slopes << -(by_1 * c1 + by_2 * c2) / blur - x[kSlopeU],
      -(by_1 * s1 + by_2 * s2) / blur - x[kSlopeV], by_1 * (-s1 * du + c1 * dv) / blur,
      by_2 * (-s2 * du + c2 * dv) / blur, -by_1 * t1 - by_2 * t2, one.value * two.value, 1, du, dv;
  return x[kLevel] + x[kSlopeU] * du + x[kSlopeV] * dv + x[kContrast] * one.value * two.value;
}

std::optional<LeastSquares> linearised(const GrayImage& image, const Eigen::Vector2d& centre,
                                       int reach_px, const CornerUnknowns& x) {
  LeastSquares sums;
  CornerUnknowns slopes;
  const bool inside = forDisc(image, centre, reach_px, [&](int u, int v, double level) {
    const double residual = level - predicted(x, u, v, &slopes);
    sums.matrix.selfadjointView<Eigen::Lower>().rankUpdate(slopes);
    sums.gradient += residual * slopes;
    sums.squares += residual * residual;
  });
  if (!inside) return std::nullopt;
  sums.matrix = sums.matrix.selfadjointView<Eigen::Lower>();
  return sums;
}

/// Initial level and contrast by linear least squares; the initial blur is one pixel.
std::optional<CornerUnknowns> unknownsAt(const GrayImage& image, const CornerStart& start,
                                         int reach_px) {
  const auto normal = [](const Eigen::Vector2d& along) {
    return std::atan2(along.x(), -along.y());
  };
  CornerUnknowns x = CornerUnknowns::Zero();
  x[kU] = start.pixel.x(), x[kV] = start.pixel.y();
  x[kAngle1] = normal(start.along_row), x[kAngle2] = normal(start.along_column);
  const auto sums = linearised(image, start.pixel, reach_px, x);
  if (!sums) return std::nullopt;
  x.tail<4>() = sums->matrix.bottomRightCorner<4, 4>().ldlt().solve(sums->gradient.tail<4>());
  return x;
}

}  // namespace

Eigen::Vector2d fitCorner(const GrayImage& image, const CornerStart& start, int reach_px) {
  const auto first = unknownsAt(image, start, reach_px);
  if (!first) return start.pixel;
  CornerUnknowns x = *first;
  auto sums = linearised(image, start.pixel, reach_px, x);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    CornerMatrix damped = sums->matrix;
    damped.diagonal() *= 1 + damping;
    const CornerUnknowns change = damped.ldlt().solve(sums->gradient);
    const CornerUnknowns tried = x + change;
    const double blur = std::exp(tried[kLogBlur]);
    const bool is_sound = change.allFinite() && blur >= kLeastBlurPx && blur <= kLargestBlurPx &&
                          (tried.head<2>() - start.pixel).norm() <= kLargestMovePx;
    const auto then = is_sound ? linearised(image, start.pixel, reach_px, tried) : std::nullopt;
    if (!then || !(then->squares <= sums->squares)) {
      damping *= 10;
      if (damping > 1e6) return start.pixel;
      continue;
    }
    x = tried;
    sums = then;
    damping = std::max(damping / 10, 1e-9);
    if (change.head<2>().norm() < kFoundPx && std::abs(x[kContrast]) >= kLeastContrast)
      return x.head<2>();
  }
  return start.pixel;
}

}  // namespace softscope
