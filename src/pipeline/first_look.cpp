#include "pipeline/first_look.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace softscope {
namespace {

constexpr int kHalf = FirstLook::kHalfPx, kSide = FirstLook::kSidePx, kPixels = FirstLook::kPixels;
constexpr int kSteps = 15;
constexpr int kRounds = 3;
constexpr double kConvergedPx = 0.005;
constexpr double kLeastCorrelation = 0.8;
constexpr double kLeastContrast = 1;     // standard deviation of the window, gray levels
constexpr double kLargestShiftPx = 4;    // from where it is expected
constexpr double kLargestSigmaPx = 0.3;  // of a place; what is less sure is often another one
constexpr double kBendSigma = 0.1;  // of the affine map's four numbers around the expected ones
constexpr double kAlike = 9;        // neighbouring pixels err alike: of so many one counts

using Row = Eigen::Matrix<double, 6, 1>;
using Window = Eigen::Matrix<double, kPixels, 1>;

double sample(const GrayImage& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const double across = u - u0, down = v - v0;
  const std::uint8_t* above = &image.values[static_cast<std::size_t>(v0) * image.width_px + u0];
  const std::uint8_t* below = above + image.width_px;
  const double first = above[0] + across * (above[1] - above[0]);
  const double second = below[0] + across * (below[1] - below[0]);
  return first + down * (second - first);
}

bool inside(const GrayImage& image, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image.width_px - 1 &&
         pixel.y() < image.height_px - 1;
}

/// Does a masked pixel share in the bilinear value at a place inside the image?
bool ignored(const Mask& ignore, const Eigen::Vector2d& pixel) {
  if (ignore.empty()) return false;
  const int u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
  return (ignore.at(u, v) | ignore.at(u + 1, v) | ignore.at(u, v + 1) | ignore.at(u + 1, v + 1)) !=
         0;
}

Eigen::Vector2d offsetOf(int i) { return {i % kSide - kHalf, i / kSide - kHalf}; }

/// Light that falls off across the window: a plane of brightness that is no texture.
class Shading {
 public:
  explicit Shading(const Window& weights) : weights_(weights) {
    for (int i = 0; i < kPixels; ++i) basis_.row(i) << 1, offsetOf(i).transpose();
    for (int k = 0; k < kTerms; ++k) {
      for (int l = 0; l < k; ++l) basis_.col(k) -= basis_.col(l) * product(l, k);
      basis_.col(k) /= std::sqrt(product(k, k));
    }
  }
  template <class Columns>
  void remove(Columns* columns) const {
    const Eigen::MatrixXd share = basis_.transpose() * weights_.asDiagonal() * *columns;
    *columns -= basis_ * share;
  }
  /// Removes it and divides by the standard deviation of what is left, which it returns.
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

/// Samples the image; false where a pixel that counts lies outside.
bool sampleWindow(const GrayImage& image, const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map,
                  const Window& weights, Window* values) {
  for (int i = 0; i < kPixels; ++i) {
    (*values)[i] = 0;
    if (weights[i] == 0) continue;
    const Eigen::Vector2d place = pixel + map * offsetOf(i);
    if (!inside(image, place)) return false;
    (*values)[i] = sample(image, place.x(), place.y());
  }
  return true;
}

/// 1 where neither the look nor the image ignores the pixel.
Window countedPixels(const FirstLook& look, const GrayImage& image, const Mask& ignore,
                     const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map) {
  constexpr double kRoomPx = kLargestShiftPx + 1;
  Window weights = Window::Zero();
  for (int i = 0; i < kPixels; ++i) {
    const Eigen::Vector2d place = pixel + map * offsetOf(i);
    const bool room = place.minCoeff() > kRoomPx && place.x() < image.width_px - 1 - kRoomPx &&
                      place.y() < image.height_px - 1 - kRoomPx;
    if (look.ignore[static_cast<std::size_t>(i)] == 0 && room && !ignored(ignore, place))
      weights[i] = 1;
  }
  return weights;
}

/// Slope of the look at each pixel, in gray levels a pixel; one-sided at its edges.
Eigen::Matrix<double, kPixels, 2> slopesOf(const Window& look) {
  Eigen::Matrix<double, kPixels, 2> slopes;
  for (int i = 0; i < kPixels; ++i) {
    const int x = i % kSide, y = i / kSide;
    const int left = x > 0 ? i - 1 : i, right = x < kSide - 1 ? i + 1 : i;
    const int up = y > 0 ? i - kSide : i, down = y < kSide - 1 ? i + kSide : i;
    slopes(i, 0) = (look[right] - look[left]) / (right - left);
    slopes(i, 1) = (look[down] - look[up]) * kSide / (down - up);
  }
  return slopes;
}

/// Where the search stands.
struct Search {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d map;
  double correlation = 0;
  double sigma_px = 0;
};

/// The six columns of the look's change under an affine map, without shading, per gray level of
/// contrast.
Eigen::Matrix<double, kPixels, 6> changesOf(const Eigen::Matrix<double, kPixels, 2>& slopes,
                                            double contrast, const Shading& shading) {
  Eigen::Matrix<double, kPixels, 6> rows;
  for (int i = 0; i < kPixels; ++i) {
    const Eigen::Vector2d at = offsetOf(i);
    const double du = slopes(i, 0) / contrast, dv = slopes(i, 1) / contrast;
    rows.row(i) << du, dv, du * at.x(), du * at.y(), dv * at.x(), dv * at.y();
  }
  shading.remove(&rows);
  return rows;
}

/// Moves the search to where the counted pixels look alike; false where they do so nowhere near
/// `expected`.
bool converge(Window first, const Window& weights, const GrayImage& image,
              const Eigen::Vector2d& expected, Search* search) {
  const Shading shading(weights);
  const Eigen::Matrix<double, kPixels, 2> slopes = slopesOf(first);
  const double contrast = shading.normalise(&first);
  if (!(contrast >= kLeastContrast)) return false;
  const Eigen::Matrix<double, kPixels, 6> rows = changesOf(slopes, contrast, shading);
  const Eigen::Matrix<double, 6, 6> normal = rows.transpose() * weights.asDiagonal() * rows;
  Eigen::Matrix<double, 6, 6> information;
  Window seen;
  for (int step = 0;; ++step) {
    if (!sampleWindow(image, search->pixel, search->map, weights, &seen)) return false;
    if (!(shading.normalise(&seen) * contrast > 0)) return false;
    search->correlation = weights.cwiseProduct(seen).dot(first) / weights.sum();
    const double variance = std::max(2 * (1 - search->correlation), 1e-4) * kAlike;
    information = normal / variance;
    information.diagonal().tail<4>().array() += 1 / (kBendSigma * kBendSigma);
    if (step == kSteps) break;
    const Row right = rows.transpose() * weights.cwiseProduct(seen - first) / variance;
    const Row change = information.ldlt().solve(right);
    Eigen::Matrix2d bend;
    bend << 1 + change[2], change[3], change[4], 1 + change[5];
    if (!(std::abs(bend.determinant()) > 0.1)) return false;
    search->map = search->map * bend.inverse();
    search->pixel -= search->map * change.head<2>();
    if (!((search->pixel - expected).norm() < kLargestShiftPx)) return false;
    if (change.head<2>().norm() < kConvergedPx) break;
  }
  const Eigen::Matrix2d covariance = information.inverse().topLeftCorner<2, 2>();
  // Singular where the look is the same all along a line.
  search->sigma_px = covariance.allFinite() && covariance.diagonal().minCoeff() >= 0
                         ? std::sqrt(covariance.diagonal().maxCoeff())
                         : std::numeric_limits<double>::infinity();
  return true;
}

}  // namespace

FirstLook FirstLook::take(const GrayImage& image, const Mask& ignore,
                          const Eigen::Vector2d& pixel) {
  FirstLook look;
  if (image.width_px < 2 || image.height_px < 2 || !pixel.allFinite()) return look;
  int counted = 0;
  const Eigen::Vector2d last(image.width_px - 1.001, image.height_px - 1.001);
  for (int i = 0; i < kPixels; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const Eigen::Vector2d place = pixel + offsetOf(i);
    const Eigen::Vector2d nearest = place.cwiseMax(0).cwiseMin(last);
    look.gray[at] = static_cast<std::uint8_t>(std::lround(sample(image, nearest.x(), nearest.y())));
    look.ignore[at] = !inside(image, place) || ignored(ignore, nearest);
    counted += look.ignore[at] == 0;
  }
  look.taken = counted >= kLeastShare * kPixels;
  return look;
}

FoundLook findLook(const FirstLook& look, const GrayImage& image, const Mask& ignore,
                   const Eigen::Vector2d& pixel, const Eigen::Matrix2d& image_from_look) {
  FoundLook result;
  result.pixel = pixel;
  if (look.taken == 0 || !pixel.allFinite() || !image_from_look.allFinite()) return result;
  Window first;
  for (int i = 0; i < kPixels; ++i) first[i] = look.gray[static_cast<std::size_t>(i)];
  Search search{pixel, image_from_look};
  Window weights = countedPixels(look, image, ignore, pixel, image_from_look);
  // Another round where other pixels are masked at the place found than at the one expected.
  for (int round = 0; round < kRounds; ++round) {
    if (weights.sum() < FirstLook::kLeastShare * kPixels) return result;
    if (!converge(first, weights, image, pixel, &search)) return result;
    const Window now = countedPixels(look, image, ignore, search.pixel, search.map);
    if (now == weights) break;
    weights = now;
  }
  result.correlation = search.correlation;
  result.sigma_px = search.sigma_px;
  result.found = search.correlation >= kLeastCorrelation && search.sigma_px <= kLargestSigmaPx;
  if (result.found) result.pixel = search.pixel;
  return result;
}

}  // namespace softscope
