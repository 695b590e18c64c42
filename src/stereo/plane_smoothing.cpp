#include "stereo/plane_smoothing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kFits = 3;            // the first to what is near, the others to what agrees
constexpr float kStepPx = 0.5f;     // neighbours of one surface differ by at most this …
constexpr float kSlope = 0.25f;     // … and this much more for every pixel between them
constexpr float kAgree = 2.5f;      // standard errors at which a neighbour counts a quarter
constexpr float kFewestPixels = 4;  // of a block, for it to have a say
constexpr float kRidge = 1e-3f;     // of the weights: planes through a line stay level

/// The mean of a square of pixels.
struct Block {
  float u = 0, v = 0, disparity_px = 0;
  float information = 0;  // sum of 1 / sigma^2 over its pixels; 0: nothing was measured
  float variance = 0;     // of a typical pixel, the harmonic mean

  bool known() const { return information > 0; }
};

/// d(u, v) = disparity + a (u - u0) + b (v - v0).
struct LocalPlane {
  float u0 = 0, v0 = 0, disparity_px = 0, a = 0, b = 0;
  float variance = 0;  // of what it predicts for a pixel; 0: there is no plane

  bool known() const { return variance > 0; }
  float at(float u, float v) const { return disparity_px + a * (u - u0) + b * (v - v0); }
};

Block meanOf(const DisparityMap& map, int u0, int v0, int size) {
  float count = 0, w = 0, wu = 0, wv = 0, wd = 0;
  const int v1 = std::min(v0 + size, map.disparity_px.height_px),
            u1 = std::min(u0 + size, map.disparity_px.width_px);
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) {
      const float d = map.disparity_px.at(u, v), sigma = map.sigma_px.at(u, v);
      if (std::isnan(d) || !(sigma > 0)) continue;
      const float weight = 1 / (sigma * sigma);
      count += 1;
      w += weight;
      wu += weight * static_cast<float>(u - u0);
      wv += weight * static_cast<float>(v - v0);
      wd += weight * d;
    }
  if (count < kFewestPixels) return {};
  return {static_cast<float>(u0) + wu / w, static_cast<float>(v0) + wv / w, wd / w, w, count / w};
}

class Planes {
 public:
  Planes(const SmoothingOptions& options, const RefinementOptions& refinement,
         const DisparityMap& map)
      : size_(options.block_px),
        reach_(options.reach_blocks),
        independent_px2_(static_cast<float>(refinement.independentPx2())),
        floor_(static_cast<float>(refinement.model_sigma_px * refinement.model_sigma_px)),
        blocks_((map.disparity_px.width_px + size_ - 1) / size_,
                (map.disparity_px.height_px + size_ - 1) / size_),
        planes_(blocks_.width_px, blocks_.height_px) {
    parallelRows(blocks_.height_px, [&](int y) {
      for (int x = 0; x < blocks_.width_px; ++x)
        blocks_.at(x, y) = meanOf(map, x * size_, y * size_, size_);
    });
    const float spread = 0.5f * static_cast<float>(reach_);
    for (int dy = -reach_; dy <= reach_; ++dy)
      for (int dx = -reach_; dx <= reach_; ++dx)
        window_.push_back(
            std::exp(-0.5f * static_cast<float>(dx * dx + dy * dy) / (spread * spread)));
    parallelRows(blocks_.height_px, [&](int y) {
      for (int x = 0; x < blocks_.width_px; ++x) planes_.at(x, y) = fit(x, y);
    });
  }

  /// What the four planes around a pixel say, each as far as the pixel agrees with it.
  void smooth(int u, int v, float& disparity_px, float& sigma_px) const {
    const float x = (static_cast<float>(u) + 0.5f) / static_cast<float>(size_) - 0.5f,
                y = (static_cast<float>(v) + 0.5f) / static_cast<float>(size_) - 0.5f;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const float variance = sigma_px * sigma_px;
    float weights = 0, sum_d = 0, sum_variance = 0;
    for (int k = 0; k < 4; ++k) {
      const int bx = x0 + k % 2, by = y0 + k / 2;
      if (!planes_.contains(bx, by) || !planes_.at(bx, by).known()) continue;
      const LocalPlane& plane = planes_.at(bx, by);
      const float predicted = plane.at(static_cast<float>(u), static_cast<float>(v));
      const float weight = (1 - std::abs(x - static_cast<float>(bx))) *
                           (1 - std::abs(y - static_cast<float>(by))) *
                           agreement(disparity_px - predicted, plane.variance + variance);
      weights += weight;
      sum_d += weight * predicted;
      sum_variance += weight * plane.variance;
    }
    if (!(weights > 0)) return;
    // As sure of the planes as the pixel agrees with them.
    const float plane_variance = sum_variance / weights / std::min(weights, 1.0f);
    const float share = plane_variance / (plane_variance + variance);
    disparity_px += (1 - share) * (sum_d / weights - disparity_px);
    sigma_px *= std::sqrt(share);
  }

 private:
  static float agreement(float residual, float variance) {
    const float q = 1 + residual * residual / (kAgree * kAgree * variance);
    return 1 / (q * q);
  }

  /// Least squares, reweighted by who agrees.
  LocalPlane fit(int x, int y) const {
    const Block& centre = blocks_.at(x, y);
    if (!centre.known()) return {};
    LocalPlane plane{centre.u, centre.v, centre.disparity_px, 0, 0, 0};
    for (int i = 0; i < kFits; ++i)
      if (!refit(x, y, i == 0, plane)) return {};
    return plane;
  }

  bool refit(int x, int y, bool first, LocalPlane& plane) const {
    Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
    Eigen::Vector3f right = Eigen::Vector3f::Zero();
    float weights = 0, squares = 0, noise = 0, information = 0;
    for (int dy = -reach_; dy <= reach_; ++dy) {
      if (y + dy < 0 || y + dy >= blocks_.height_px) continue;
      for (int dx = -reach_; dx <= reach_; ++dx) {
        if (x + dx < 0 || x + dx >= blocks_.width_px) continue;
        const Block& other = blocks_.at(x + dx, y + dy);
        if (!other.known()) continue;
        const float du = other.u - plane.u0, dv = other.v - plane.v0;
        const float residual =
            other.disparity_px - plane.disparity_px - plane.a * du - plane.b * dv;
        float trust =
            window_[static_cast<std::size_t>((dy + reach_) * (2 * reach_ + 1) + dx + reach_)];
        if (first) {
          if (std::abs(residual) > kStepPx + kSlope * std::sqrt(du * du + dv * dv)) continue;
        } else {
          trust *= agreement(residual, plane.variance + other.variance);
        }
        const float weight = trust * other.information;
        const Eigen::Vector3f row(1, du, dv);
        normal.noalias() += weight * row * row.transpose();
        right += weight * residual * row;
        weights += weight;
        squares += weight * residual * residual;
        noise += weight * other.variance;
        information += trust * other.information;
      }
    }
    if (!(weights > 0)) return false;
    const float ridge = kRidge * weights * static_cast<float>(size_ * size_);
    normal(1, 1) += ridge;
    normal(2, 2) += ridge;
    const Eigen::LDLT<Eigen::Matrix3f> solver(normal);
    const Eigen::Vector3f step = solver.solve(right);
    // The residuals that are left, by the normal equations.
    const float left = std::max(squares - step.dot(right), 0.0f) / weights;
    const float relief = std::max(left - noise / weights, 0.0f);
    plane.disparity_px += step[0];
    plane.a += step[1];
    plane.b += step[2];
    plane.variance = floor_ + relief + independent_px2_ / information;
    return true;
  }

  int size_, reach_;
  float independent_px2_, floor_;
  Raster<Block> blocks_;
  Raster<LocalPlane> planes_;
  std::vector<float> window_;
};

}  // namespace

void smoothByPlanes(const SmoothingOptions& options, const RefinementOptions& refinement,
                    DisparityMap& map) {
  if (options.reach_blocks == 0) return;
  const Planes planes(options, refinement, map);
  parallelRows(map.disparity_px.height_px, [&](int v) {
    float* disparity = map.disparity_px.row(v);
    float* sigma = map.sigma_px.row(v);
    for (int u = 0; u < map.disparity_px.width_px; ++u)
      if (!std::isnan(disparity[u]) && sigma[u] > 0) planes.smooth(u, v, disparity[u], sigma[u]);
  });
}

}  // namespace softscope
