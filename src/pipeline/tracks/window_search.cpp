#include "pipeline/tracks/window_search.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "pipeline/tracks/look_kernels.h"

namespace softscope {
namespace {

constexpr int kSteps = 15;
constexpr int kRounds = 3;
constexpr double kConvergedPx = 0.005;
constexpr double kLeastCorrelation = 0.8;
constexpr double kLeastContrast = 1;     // standard deviation of the window, gray levels
constexpr double kLargestShiftPx = 4;    // from the expected position
constexpr double kLargestSigmaPx = 0.3;  // of a position; less certain ones are often wrong
constexpr double kBendSigma = 0.1;  // of the affine map's four numbers around the expected ones
constexpr double kAlike = 9;        // number of neighbouring pixels with correlated errors
constexpr double kLeastVariance = 1e-4;  // of a pixel's difference, for a window of contrast 1
constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Row = Eigen::Matrix<double, 6, 1>;
using Normal = Eigen::Matrix<double, 6, 6>;
using Unknowns = Eigen::Map<const Row>;

LookPlaces placesOf(const LookSearch& search) {
  const double u = std::floor(search.pixel.x()), v = std::floor(search.pixel.y());
  return {static_cast<int>(u),
          static_cast<int>(v),
          static_cast<float>(search.pixel.x() - u),
          static_cast<float>(search.pixel.y() - v),
          {static_cast<float>(search.map(0, 0)), static_cast<float>(search.map(0, 1)),
           static_cast<float>(search.map(1, 0)), static_cast<float>(search.map(1, 1))}};
}

/// Variance of a pixel difference, counted as independent.
double varianceOf(double correlation) {
  return std::max(2 * (1 - correlation), kLeastVariance) * kAlike;
}

/// Information of the search about the six parameters:
/// that of the pixels, and the prior of the map.
Normal informationOf(const Normal& normal, double variance) {
  Normal information = normal / variance;
  information.diagonal().tail<4>().array() += 1 / (kBendSigma * kBendSigma);
  return information;
}

/// Difference of the current map from the expected one, row by row.
Eigen::Vector4d bendOf(const LookSearch& search, const LookSearch& expected) {
  const Eigen::Matrix2d bend = expected.map.inverse() * search.map - Eigen::Matrix2d::Identity();
  return {bend(0, 0), bend(0, 1), bend(1, 0), bend(1, 1)};
}

/// Search of one window in one image.
class FirstLookMatcher {
 public:
  FirstLookMatcher(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore)
      : image_{image.values.data(), image.width_px, image.height_px},
        ignore_{ignore.empty() ? nullptr : ignore.values.data(), image.width_px, image.height_px} {
    ignored_.fill(1);
    std::copy(look.gray.begin(), look.gray.end(), gray_.begin());
    std::copy(look.ignore.begin(), look.ignore.end(), ignored_.begin());
    least_count_ = FirstLook::kLeastShare *
                   static_cast<double>(std::count(ignored_.begin(), ignored_.end(), 0));
  }

  bool find(const LookSearch& expected, LookSearch* search) {
    if (!countPixels(*search)) return false;
    // Another round if other pixels are masked at the position found than at the expected one.
    for (int round = 1;; ++round) {
      if (!converge(expected, search)) return false;
      if (round == kRounds) break;
      const LookPlane before = look_.weights;
      const bool enough = countPixels(*search);
      if (std::equal(std::begin(before.values), std::end(before.values), look_.weights.values))
        break;
      if (!enough) return false;
    }
    search->converged = true;
    if (search->correlation < kLeastCorrelation) return false;
    search->sigma_px = sigmaAt(*search);
    return search->sigma_px <= kLargestSigmaPx;
  }

 private:
  /// False if too few pixels of the window count.
  bool countPixels(const LookSearch& search) {
    constexpr double kRoomPx = kLargestShiftPx + 1;
    if (!contains(search.pixel)) return false;
    kernels_.countPixels(ignored_.data(), ignore_, placesOf(search), kRoomPx, &look_);
    return look_.count >= least_count_;
  }
  /// False for NaN.
  bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image_.width_px - 1 &&
           pixel.y() < image_.height_px - 1;
  }

  /// Moves the search to the position where the counted
  /// pixels agree; false if there is none near `expected`.
  bool converge(const LookSearch& expected, LookSearch* search) {
    kernels_.describeLook(gray_.data(), &look_);
    if (!(look_.contrast >= kLeastContrast)) return false;
    for (int step = 0;; ++step) {
      if (!contains(search->pixel) ||
          !kernels_.sampleLook(look_, image_, placesOf(*search), &seen_))
        return false;
      if (!(seen_.deviation > 0)) return false;
      search->correlation = seen_.with_first / (seen_.deviation * look_.count);
      if (step == kSteps) return true;
      const Row change = stepFrom(*search, expected);
      Eigen::Matrix2d bend;
      bend << 1 + change[2], change[3], change[4], 1 + change[5];
      if (!(std::abs(bend.determinant()) > 0.1)) return false;
      search->map = search->map * bend.inverse();
      search->pixel -= search->map * change.head<2>();
      if (!((search->pixel - expected.pixel).norm() < kLargestShiftPx)) return false;
      if (change.head<2>().norm() < kConvergedPx) return true;
    }
  }

  Row stepFrom(const LookSearch& search, const LookSearch& expected) const {
    const double variance = varianceOf(search.correlation);
    Row right =
        (Unknowns(seen_.with_changes) / seen_.deviation - Unknowns(look_.first_changes)) / variance;
    right.tail<4>() += bendOf(search, expected) / (kBendSigma * kBendSigma);
    return informationOf(Normal(look_.normal[0]), variance).ldlt().solve(right);
  }

  /// Predicted standard error of the position along its worst direction, from
  /// the difference of the windows; infinite without information. Half of the
  /// difference is the noise of the look, whose slopes counted as texture.
  double sigmaAt(const LookSearch& search) const {
    LookPlane difference;
    kernels_.differenceOf(look_, seen_, &difference);
    double noise[kMapUnknowns][kMapUnknowns];
    kernels_.normalOfNoise(look_, difference, noise);
    const Normal normal(look_.normal[0]);
    const double variance = varianceOf(search.correlation);
    const Normal texture = normal - 0.5 * Normal(noise[0]);
    const Eigen::LDLT<Normal> information(informationOf(texture, variance));
    const Row right = information.solve(Row::Unit(0)), down = information.solve(Row::Unit(1));
    if (!(right[0] > 0 && right[0] * down[1] > right[1] * down[0])) return kInfinite;
    Eigen::Matrix<double, 2, 6> place;  // change of the position per pixel term
    place << right.transpose(), down.transpose();
    place /= variance;
    const Eigen::Matrix<double, 2, 4> bend = place.rightCols<4>() * variance / kBendSigma;
    const Eigen::Matrix2d covariance =
        covarianceOfSum(difference, place) + bend * bend.transpose() +
        kLeastVariance * kAlike * (place.lazyProduct(normal)).lazyProduct(place.transpose());
    return covariance.allFinite() ? std::sqrt(covariance.diagonal().maxCoeff()) : kInfinite;
  }

  /// Covariance of the sum over pixels if errors within kBoxPx are correlated: sums over
  /// squares of pixels, squared (triangular kernel: Newey and West, Econometrica 1987).
  Eigen::Matrix2d covarianceOfSum(const LookPlane& difference,
                                  const Eigen::Matrix<double, 2, 6>& place) const {
    float terms[2][kMapUnknowns];
    for (int axis = 0; axis < 2; ++axis)
      for (int k = 0; k < kMapUnknowns; ++k) terms[axis][k] = static_cast<float>(place(axis, k));
    double sums[3];
    kernels_.boxSums(look_, difference, terms, sums);
    Eigen::Matrix2d covariance;
    covariance << sums[0], sums[1], sums[1], sums[2];
    return covariance / (kBoxPx * kBoxPx);
  }

  const LookKernels& kernels_ = lookKernels();
  LookImage image_, ignore_;
  std::array<std::uint8_t, kLookValues> gray_{}, ignored_;
  double least_count_ = 0;
  LookTemplate look_;
  LookSamples seen_;
};

}  // namespace

bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const Eigen::Matrix2d& image_from_look, LookSearch* search) {
  search->sigma_px = kInfinite;
  if (look.taken == 0) return false;
  const LookSearch expected{search->pixel, image_from_look};
  return FirstLookMatcher(look, image, ignore).find(expected, search);
}

}  // namespace softscope
