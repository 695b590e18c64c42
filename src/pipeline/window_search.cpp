#include "pipeline/window_search.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

namespace softscope {
namespace {

constexpr int kSide = FirstLook::kSidePx, kPixels = FirstLook::kPixels;
constexpr int kSteps = 15;
constexpr int kRounds = 3;
constexpr double kConvergedPx = 0.005;
constexpr double kLeastCorrelation = 0.8;
constexpr double kLeastContrast = 1;     // standard deviation of the window, gray levels
constexpr double kLargestShiftPx = 4;    // from the expected position
constexpr double kLargestSigmaPx = 0.3;  // of a position; less certain ones are often wrong
constexpr double kBendSigma = 0.1;  // of the affine map's four numbers around the expected ones
constexpr double kAlike = 9;        // number of neighbouring pixels with correlated errors
constexpr int kAlikeHalfPx = 2;     // their distance
constexpr double kLeastVariance = 1e-4;  // of a pixel's difference, for a window of contrast 1

using Row = Eigen::Matrix<double, 6, 1>;
using Normal = Eigen::Matrix<double, 6, 6>;
using Window = Eigen::Matrix<double, kPixels, 1>;
using Changes = Eigen::Matrix<double, kPixels, 6>;  // of a window under an affine map

/// Light that varies linearly across the window: a plane of brightness that is no texture.
class Shading {
 public:
  explicit Shading(const Window& weights) : weights_(weights) {
    for (int i = 0; i < kPixels; ++i) basis_.row(i) << 1, windowOffset(i).transpose();
    for (int k = 0; k < kTerms; ++k) {
      for (int l = 0; l < k; ++l) basis_.col(k) -= basis_.col(l) * product(l, k);
      basis_.col(k) /= std::sqrt(product(k, k));
    }
  }
  template <class Columns>
  void remove(Columns* columns) const {
    for (int k = 0; k < kTerms; ++k) {
      const Window term = basis_.col(k), counted = weights_.cwiseProduct(term);
      for (int c = 0; c < columns->cols(); ++c)
        columns->col(c) -= counted.dot(columns->col(c)) * term;
    }
  }
  /// Removes it and divides by the standard deviation of the rest, which it returns.
  double normalise(Window* values) const {
    remove(values);
    const double deviation = std::sqrt(weights_.dot(values->cwiseAbs2()) / weights_.sum());
    *values /= deviation;
    return deviation;
  }

 private:
  static constexpr int kTerms = 3;
  double product(int k, int l) const {
    return weights_.cwiseProduct(basis_.col(k)).dot(basis_.col(l));
  }

  Window weights_;                                // 0 or 1
  Eigen::Matrix<double, kPixels, kTerms> basis_;  // orthonormal
};

/// Positions of the pixels of a window in the image.
struct WindowPlaces {
  std::array<double, kPixels> u, v;

  WindowPlaces(const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map) {
    for (int y = 0; y < kSide; ++y) {
      const double down = y - FirstLook::kHalfPx;
      const double u_down = map(0, 1) * down, v_down = map(1, 1) * down;
      for (int x = 0; x < kSide; ++x) {
        const double across = x - FirstLook::kHalfPx;
        const std::size_t i = static_cast<std::size_t>(y * kSide + x);
        u[i] = pixel.x() + (map(0, 0) * across + u_down);
        v[i] = pixel.y() + (map(1, 0) * across + v_down);
      }
    }
  }
};

/// Samples the image; false if a pixel that counts is outside.
bool sampleWindow(const GrayImage& image, const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map,
                  const Window& weights, Window* values) {
  const WindowPlaces places(pixel, map);
  for (int i = 0; i < kPixels; ++i) {
    const double u = places.u[static_cast<std::size_t>(i)],
                 v = places.v[static_cast<std::size_t>(i)];
    (*values)[i] = 0;
    if (weights[i] == 0) continue;
    if (!sampleable(image, u, v)) return false;
    (*values)[i] = sampleAt(image, u, v);
  }
  return true;
}

/// 1 for pixels ignored by neither the look nor the image.
Window countedPixels(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                     const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map) {
  constexpr double kRoomPx = kLargestShiftPx + 1;
  const double last_u = image.width_px - 1 - kRoomPx, last_v = image.height_px - 1 - kRoomPx;
  const WindowPlaces places(pixel, map);
  Window weights = Window::Zero();
  for (int i = 0; i < kPixels; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double u = places.u[k], v = places.v[k];
    const bool room = u > kRoomPx && v > kRoomPx && u < last_u && v < last_v;
    if (look.ignore[k] == 0 && room && !ignoredAt(ignore, u, v)) weights[i] = 1;
  }
  return weights;
}

/// Slope of the look per pixel, in gray levels per pixel; 0 at its edges, where
/// one-sided differences would correlate with the noise of the pixel itself.
Eigen::Matrix<double, kPixels, 2> slopesOf(const Window& look) {
  Eigen::Matrix<double, kPixels, 2> slopes = Eigen::Matrix<double, kPixels, 2>::Zero();
  for (int y = 1; y < kSide - 1; ++y)
    for (int i = y * kSide + 1; i < (y + 1) * kSide - 1; ++i)
      slopes.row(i) << (look[i + 1] - look[i - 1]) / 2, (look[i + kSide] - look[i - kSide]) / 2;
  return slopes;
}

/// The six columns of the change of the look under an
/// affine map, without shading, per gray level of contrast.
Changes changesOf(const Eigen::Matrix<double, kPixels, 2>& slopes, double contrast,
                  const Shading& shading) {
  Changes rows;
  for (int i = 0; i < kPixels; ++i) {
    const Eigen::Vector2d at = windowOffset(i);
    const double du = slopes(i, 0) / contrast, dv = slopes(i, 1) / contrast;
    rows.row(i) << du, dv, du * at.x(), du * at.y(), dv * at.x(), dv * at.y();
  }
  shading.remove(&rows);
  return rows;
}

/// Covariance of the sum over pixels if errors within 2 kAlikeHalfPx are correlated: sums
/// over squares of pixels, squared (triangular kernel: Newey and West, Econometrica 1987).
Eigen::Matrix2d covarianceOfSum(const Eigen::Matrix<double, kPixels, 2>& said) {
  constexpr int kBorder = 2 * kAlikeHalfPx, kBox = kBorder + 1, kWide = kSide + kBorder;
  constexpr int kSums = kSide * kWide;  // of five neighbouring pixels
  using Sums = Eigen::Matrix<double, 2, kSums>;
  Sums across = Sums::Zero();
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u)
      for (int x = u; x < u + kBox; ++x)
        across.col(v * kWide + x) += said.row(v * kSide + u).transpose();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int y = 0; y < kWide; ++y)
    for (int x = 0; x < kWide; ++x) {
      Eigen::Vector2d box = Eigen::Vector2d::Zero();
      for (int v = std::max(0, y - kBorder); v <= std::min(kSide - 1, y); ++v)
        box += across.col(v * kWide + x);
      sum += box * box.transpose();
    }
  return sum / (kBox * kBox);
}

/// Variance of a pixel difference, counted as independent.
double varianceOf(double correlation) {
  return std::max(2 * (1 - correlation), kLeastVariance) * kAlike;
}

Normal normalOf(const Changes& rows, const Window& weights) {
  Normal normal;
  for (int k = 0; k < 6; ++k) {
    const Window counted = weights.cwiseProduct(rows.col(k));
    for (int l = k; l < 6; ++l) normal(k, l) = normal(l, k) = counted.dot(rows.col(l));
  }
  return normal;
}

/// Result of the last step of the search.
struct WindowFit {
  const Window& weights;
  const Changes& rows;
  const Normal& normal;
  const Window& residual;
  double variance;  // of a pixel's difference, as used in the search
};

/// Information of the search about the six parameters:
/// that of the pixels, and the prior of the map.
Normal informationOf(const Normal& normal, double variance) {
  Normal information = normal / variance;
  information.diagonal().tail<4>().array() += 1 / (kBendSigma * kBendSigma);
  return information;
}

/// Predicted standard error of the position along its worst direction, from
/// the difference of the windows; infinite without information. Half of the
/// difference is the noise of the look, whose slopes counted as texture.
double sigmaOf(const WindowFit& fit, const Shading& shading) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Changes noise = changesOf(slopesOf(fit.residual), 1, shading);
  const Normal texture = fit.normal - 0.5 * normalOf(noise, fit.weights);
  const Eigen::LDLT<Normal> information(informationOf(texture, fit.variance));
  const Row right = information.solve(Row::Unit(0)), down = information.solve(Row::Unit(1));
  if (!(right[0] > 0 && right[0] * down[1] > right[1] * down[0])) return kInfinite;
  Eigen::Matrix<double, 2, 6> place;  // change of the position per pixel term
  place << right.transpose(), down.transpose();
  place /= fit.variance;
  const Eigen::Matrix<double, kPixels, 2> said =
      (fit.residual.asDiagonal() * fit.rows).lazyProduct(place.transpose());
  const Eigen::Matrix<double, 2, 4> bend = place.rightCols<4>() * fit.variance / kBendSigma;
  const Eigen::Matrix2d covariance =
      covarianceOfSum(said) + bend * bend.transpose() +
      kLeastVariance * kAlike * (place.lazyProduct(fit.normal)).lazyProduct(place.transpose());
  return covariance.allFinite() ? std::sqrt(covariance.diagonal().maxCoeff()) : kInfinite;
}

/// Difference of the current map from the expected one, row by row.
Eigen::Vector4d bendOf(const LookSearch& search, const LookSearch& expected) {
  const Eigen::Matrix2d bend = expected.map.inverse() * search.map - Eigen::Matrix2d::Identity();
  return {bend(0, 0), bend(0, 1), bend(1, 0), bend(1, 1)};
}

/// Moves the search to the position where the counted
/// pixels agree; false if there is none near `expected`.
bool converge(Window first, const Window& weights, const GrayImage& image,
              const LookSearch& expected, LookSearch* search) {
  const Shading shading(weights);
  const Eigen::Matrix<double, kPixels, 2> slopes = slopesOf(first);
  const double contrast = shading.normalise(&first);
  if (!(contrast >= kLeastContrast)) return false;
  const Changes rows = changesOf(slopes, contrast, shading);
  const Normal normal = normalOf(rows, weights);
  Window residual;
  for (int step = 0;; ++step) {
    Window seen;
    if (!sampleWindow(image, search->pixel, search->map, weights, &seen)) return false;
    if (!(shading.normalise(&seen) * contrast > 0)) return false;
    search->correlation = weights.cwiseProduct(seen).dot(first) / weights.sum();
    residual = weights.cwiseProduct(seen - first);
    if (step == kSteps) break;
    const double variance = varianceOf(search->correlation);
    Row right = rows.transpose().lazyProduct(residual) / variance;
    right.tail<4>() += bendOf(*search, expected) / (kBendSigma * kBendSigma);
    const Row change = informationOf(normal, variance).ldlt().solve(right);
    Eigen::Matrix2d bend;
    bend << 1 + change[2], change[3], change[4], 1 + change[5];
    if (!(std::abs(bend.determinant()) > 0.1)) return false;
    search->map = search->map * bend.inverse();
    search->pixel -= search->map * change.head<2>();
    if (!((search->pixel - expected.pixel).norm() < kLargestShiftPx)) return false;
    if (change.head<2>().norm() < kConvergedPx) break;
  }
  search->sigma_px =
      sigmaOf({weights, rows, normal, residual, varianceOf(search->correlation)}, shading);
  return true;
}

}  // namespace

bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const Eigen::Matrix2d& image_from_look, LookSearch* search) {
  if (look.taken == 0) return false;
  const LookSearch expected{search->pixel, image_from_look};
  Window first;
  for (int i = 0; i < kPixels; ++i) first[i] = look.gray[static_cast<std::size_t>(i)];
  Window weights = countedPixels(look, image, ignore, search->pixel, search->map);
  // Another round if other pixels are masked at the position found than at the expected one.
  for (int round = 0; round < kRounds; ++round) {
    if (weights.sum() < FirstLook::kLeastShare * kPixels) return false;
    if (!converge(first, weights, image, expected, search)) return false;
    const Window now = countedPixels(look, image, ignore, search->pixel, search->map);
    if (now == weights) break;
    weights = now;
  }
  return search->correlation >= kLeastCorrelation && search->sigma_px <= kLargestSigmaPx;
}

}  // namespace softscope
