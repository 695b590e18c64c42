#include "stereo/subpixel_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/depth_steps.h"
#include "stereo/kernel_sets.h"
#include "stereo/plane.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kWindowSigma = 0.55;    // of the radius
constexpr float kFarthestStepPx = 1.5f;  // a fit that wanders farther has lost its pixel
constexpr float kStepPx = 1.0f;          // neighbours of one surface differ by at most this …
constexpr float kSlope = 0.4f;           // … and this much more for every pixel between them
constexpr float kClearStepPx = 2.0f;     // a step that is no noise of the matching
constexpr int kBandRows = 80;            // solved by one thread at a time

std::vector<float> gaussian(double sigma, int radius) {
  std::vector<float> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    weights.push_back(static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
  return weights;
}

/// What all bands share: the pictures, the window, and how to weigh.
struct Setting {
  Setting(const GrayImage& left_image, const GrayImage& right_image,
          const Raster<float>& initial_px, const RefinementOptions& refinement)
      : options(refinement),
        left(bandPass(left_image, refinement.highpass_sigma_px)),
        right(bandPass(right_image, refinement.highpass_sigma_px)),
        near_step(nearDepthSteps(initial_px, refinement.radius_px, kClearStepPx, kSlope)),
        window(gaussian(kWindowSigma * refinement.radius_px, refinement.radius_px)) {
    const int radius = options.radius_px;
    for (int y = -radius; y <= radius; ++y)
      for (int i = 0; i < kSelectLanes; ++i) {
        const int x = i - radius;
        selection_window.push_back(x <= radius ? window[y + radius] * window[i] : 0.0f);
        selection_tolerance.push_back(kStepPx +
                                      kSlope * std::sqrt(static_cast<float>(x * x + y * y)));
      }
  }

  float priorWeight() const {
    return static_cast<float>(std::pow(options.noise_gray / options.prior_sigma_px, 2));
  }

  RefinementOptions options;
  Plane left, right;
  Raster<std::uint8_t> near_step;
  std::vector<float> window, selection_window, selection_tolerance;
};

/// A band of rows, solved from top to bottom. Only the rows that a window needs are held, so that
/// they stay in the cache.
class Band {
 public:
  Band(const Setting& setting, const Raster<float>& disparity, bool last, DisparityMap& out)
      : setting_(setting),
        radius_(setting.options.radius_px),
        width_(disparity.width_px),
        disparity_(disparity),
        last_(last),
        out_(out),
        pixels_(kPixelPlanes, Plane(width_, 2 * height())),
        rows_(kRowPlanes, Plane(width_, height())),
        moments_(width_, kMomentCount) {}

  void solve(int begin, int end) {
    for (int v = begin - radius_; v < end + radius_; ++v) {
      linearise(v);
      if (v - radius_ >= begin) solveRow(v - radius_);
    }
  }

 private:
  // What is known of each pixel, and the sums along its row.
  enum {
    kDisparity,
    kInformation,
    kTarget,
    kResidualSq,
    kWeight,
    kDifferenceSq,
    kEnergy,
    kPixelPlanes
  };
  enum { kG0, kG1, kG2, kQ0, kQ1, kE0, kE1, kE2, kE3, kRowPlanes };

  int height() const { return 2 * radius_ + 1; }
  int slot(int v) const { return (v + height()) % height(); }

  /// Residual and gradient of every pixel of a row at its present disparity, and their row sums.
  void linearise(int v) {
    const bool inside = v >= 0 && v < disparity_.height_px;
    for (int u = 0; u < width_; ++u) {
      const float value = inside ? disparity_.at(u, v) : kNaN;
      valid_[u] = std::isnan(value) ? 0.0f : 1.0f;
      pixels_[kDisparity].row(slot(v))[u] = std::isnan(value) ? 0.0f : value;
    }
    const auto pixel = [&](int plane) { return pixels_[plane].row(slot(v)); };
    const auto row = [&](int plane) { return rows_[plane].row(slot(v)); };
    const float noise = static_cast<float>(setting_.options.noise_gray);
    const int source = inside ? v : 0;
    const RefinementKernels& kernels = refinementKernels();
    kernels.residualRow({setting_.left.row(source), setting_.right.row(source), pixel(kDisparity),
                         valid_.data(), width_, 1 / (noise * noise), setting_.priorWeight(),
                         pixel(kInformation), pixel(kTarget), pixel(kResidualSq), pixel(kWeight),
                         pixel(kDifferenceSq), pixel(kEnergy)});
    const float* window = setting_.window.data();
    kernels.horizontalMoments(pixel(kInformation), window, radius_, width_, row(kG0), row(kG1),
                              row(kG2));
    kernels.horizontalMoments(pixel(kTarget), window, radius_, width_, row(kQ0), row(kQ1), nullptr);
    for (int k = 0; k < 4 && last_; ++k)
      kernels.horizontalMoments(pixel(kResidualSq + k), window, radius_, width_, row(kE0 + k),
                                nullptr, nullptr);
    // A second copy, so that the rows around any row follow each other.
    for (Plane& plane : pixels_)
      std::copy_n(plane.row(slot(v)) - Plane::kMargin, width_ + 2 * Plane::kMargin,
                  plane.row(slot(v) + height()) - Plane::kMargin);
  }

  /// Sums over the windows of a row, then the plane of each pixel.
  void solveRow(int v) {
    MomentRow moments;
    for (int k = 0; k < kMomentCount; ++k) moments.sums[k] = moments_.row(k);
    sumWindows(v, moments);
    for (int u = 0; u < width_; ++u)
      if (setting_.near_step.at(u, v) != 0 && !std::isnan(disparity_.at(u, v)))
        selectWindow(u, v, moments);
    const RefinementOptions& options = setting_.options;
    const auto squared = [](double x) { return static_cast<float>(x * x); };
    const float relaxation = last_ ? 1.0f : static_cast<float>(options.relaxation);
    const PlaneRow row{moments,
                       disparity_.row(v),
                       width_,
                       kFarthestStepPx,
                       setting_.priorWeight(),
                       squared(options.noise_floor_gray),
                       static_cast<float>(4 * M_PI) * squared(kWindowSigma * radius_),
                       squared(options.model_sigma_px),
                       squared(options.max_sigma_px),
                       static_cast<float>(options.max_difference),
                       relaxation,
                       out_.disparity_px.row(v),
                       out_.sigma_px.row(v)};
    refinementKernels().solvePlanes(row);
    if (last_) refinementKernels().judgePlanes(row);
  }

  void sumWindows(int v, const MomentRow& moments) {
    const float* around[kRowPlanes][2 * Plane::kMargin];
    for (int plane = 0; plane < kRowPlanes; ++plane)
      for (int y = 0; y < height(); ++y) around[plane][y] = rows_[plane].row(slot(v - radius_ + y));
    const float* window = setting_.window.data();
    const RefinementKernels& kernels = refinementKernels();
    kernels.verticalMoments(around[kG0], around[kG1], around[kG2], around[kQ0], around[kQ1], window,
                            radius_, width_, moments);
    for (int k = 0; k < 4 && last_; ++k)
      kernels.sumRows(around[kE0 + k], window, height(), width_, moments.sums[9 + k]);
  }

  void selectWindow(int u, int v, const MomentRow& moments) {
    const int centre = slot(v - radius_) + radius_;  // in the doubled planes
    const auto at = [&](int plane) { return pixels_[plane].row(centre) + u; };
    refinementKernels().selectedMoments(
        {at(kInformation), at(kTarget), at(kResidualSq), at(kWeight), at(kDifferenceSq),
         at(kEnergy), at(kDisparity), pixels_[0].stride(), setting_.selection_window.data(),
         setting_.selection_tolerance.data(), radius_},
        u, moments);
  }

  const Setting& setting_;
  int radius_, width_;
  const Raster<float>& disparity_;
  bool last_;  // takes whole steps and judges them
  DisparityMap& out_;
  std::vector<Plane> pixels_, rows_;
  Plane moments_;
  std::vector<float> valid_ = std::vector<float>(static_cast<std::size_t>(width_));
};

}  // namespace

DisparityMap refineDisparity(const GrayImage& left, const GrayImage& right,
                             const Raster<float>& initial_px, const RefinementOptions& options) {
  const Setting setting(left, right, initial_px, options);
  const int width = left.width_px, height = left.height_px;
  DisparityMap map{initial_px, Raster<float>(width, height, kNaN)};
  DisparityMap next = map;
  for (int i = 0; i < options.iterations; ++i) {
    const bool last = i + 1 == options.iterations;
    parallelRanges(height, kBandRows, [&](int begin, int end) {
      Band(setting, map.disparity_px, last, next).solve(begin, end);
    });
    std::swap(map, next);
  }
  return map;
}

}  // namespace softscope
