#include "stereo/patch_smoothing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kFits = 2;            // first to what is near, then to what agrees
constexpr float kStepPx = 0.5f;     // neighbours of one surface differ by at most this …
constexpr float kSlope = 0.25f;     // … and this much more for every pixel between them
constexpr float kAgree = 2.5f;      // standard errors at which a neighbour counts a quarter
constexpr float kFewestPixels = 4;  // of a block, for it to have a say
constexpr float kRidge = 1e-3f;     // of the weights: patches through a line stay level

/// The mean of a square of pixels.
struct Block {
  float u = 0, v = 0, disparity_px = 0;
  float information = 0;  // sum of 1 / sigma^2 over its pixels; 0: nothing was measured
  float variance = 0;     // of a typical pixel, the harmonic mean

  bool known() const { return information > 0; }
};

using Coefficients = Eigen::Matrix<float, 6, 1>;
using PaddedRow = Eigen::Matrix<float, 8, 1>;  // two registers of four; the last two are 0

/// d(u, v) = c . (1, x, y, x², xy, y²), x and y from (u0, v0) in windows.
struct Patch {
  float u0 = 0, v0 = 0;
  Coefficients c = Coefficients::Zero();
  float variance = 0;  // of what it predicts for a pixel; 0: there is no patch

  bool known() const { return variance > 0; }
  PaddedRow row(float u, float v, float scale) const {
    const float x = (u - u0) * scale, y = (v - v0) * scale;
    PaddedRow r;
    r << 1, x, y, x * x, x * y, y * y, 0, 0;
    return r;
  }
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

class Patches {
 public:
  Patches(const SmoothingOptions& options, const RefinementOptions& refinement,
          const DisparityMap& map)
      : size_(options.blockPx(map.disparity_px.width_px)),
        reach_(options.reach_blocks),
        scale_(1 / static_cast<float>(reach_ * size_)),
        independent_px2_(static_cast<float>(refinement.independentPx2())),
        floor_(static_cast<float>(refinement.model_sigma_px * refinement.model_sigma_px +
                                  options.relief_px * options.relief_px)),
        blocks_((map.disparity_px.width_px + size_ - 1) / size_,
                (map.disparity_px.height_px + size_ - 1) / size_),
        patches_(blocks_.width_px, blocks_.height_px) {
    parallelRows(blocks_.height_px, [&](int y) {
      for (int x = 0; x < blocks_.width_px; ++x)
        blocks_.at(x, y) = meanOf(map, x * size_, y * size_, size_);
    });
    const float spread = 0.5f * static_cast<float>(reach_);
    for (int dy = -reach_; dy <= reach_; ++dy)
      for (int dx = -reach_; dx <= reach_; ++dx)
        window_.push_back(
            std::exp(-0.5f * static_cast<float>(dx * dx + dy * dy) / (spread * spread)));
    parallelRanges(blocks_.height_px, 1, [&](int begin, int end) {  // a row is work enough
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < blocks_.width_px; ++x) patches_.at(x, y) = fit(x, y);
    });
  }

  /// Draws a row of pixels to what the four patches around each say, as far as it agrees with them.
  void smoothRow(int v, int width, float* disparity_px, float* sigma_px) const {
    const float y = (static_cast<float>(v) + 0.5f) / static_cast<float>(size_) - 0.5f;
    const int y0 = static_cast<int>(std::floor(y));
    const float down = y - static_cast<float>(y0);
    int held = -1;  // the cell of the first pixel
    Quartet four = around(held, y0, down);
    for (int u = 0; u < width; ++u) {
      const float x = (static_cast<float>(u) + 0.5f) / static_cast<float>(size_) - 0.5f;
      const int x0 = static_cast<int>(std::floor(x));
      if (x0 != held) {
        held = x0;
        four = around(x0, y0, down);
      }
      if (!std::isnan(disparity_px[u]) && sigma_px[u] > 0)
        smooth(four, x - static_cast<float>(x0), static_cast<float>(u), static_cast<float>(v),
               disparity_px[u], sigma_px[u]);
    }
  }

 private:
  using Array4f = Eigen::Array4f;

  /// Four neighbouring patches side by side: left, right, below left, below right.
  struct Quartet {
    Array4f u0, v0, c[6], variance;
    Array4f share_left, share_right;  // of each at the left and at the right end of the cell
  };

  Quartet around(int x0, int y0, float down) const {
    Quartet four;
    for (int k = 0; k < 4; ++k) {
      const int x = x0 + k % 2, y = y0 + k / 2;
      const bool known = patches_.contains(x, y) && patches_.at(x, y).known();
      const Patch patch = known ? patches_.at(x, y) : Patch();
      const float share = known ? (k < 2 ? 1 - down : down) : 0.0f;
      four.u0[k] = patch.u0;
      four.v0[k] = patch.v0;
      for (int i = 0; i < 6; ++i) four.c[i][k] = patch.c[i];
      four.variance[k] = known ? patch.variance : 1.0f;
      four.share_left[k] = k % 2 == 0 ? share : 0.0f;
      four.share_right[k] = k % 2 == 0 ? 0.0f : share;
    }
    return four;
  }

  void smooth(const Quartet& four, float right, float u, float v, float& disparity_px,
              float& sigma_px) const {
    const float variance = sigma_px * sigma_px;
    const Array4f x = (u - four.u0) * scale_, y = (v - four.v0) * scale_;
    const Array4f predicted = four.c[0] + x * (four.c[1] + x * four.c[3] + y * four.c[4]) +
                              y * (four.c[2] + y * four.c[5]);
    const Array4f q =
        1 + (disparity_px - predicted).square() / (kAgree * kAgree * (four.variance + variance));
    const Array4f weight = (four.share_left * (1 - right) + four.share_right * right) / q.square();
    const float weights = weight.sum();
    if (!(weights > 0)) return;
    // As sure of the patches as the pixel agrees with them.
    const float patch_variance = (weight * four.variance).sum() / weights / std::min(weights, 1.0f);
    const float share = patch_variance / (patch_variance + variance);
    disparity_px += (1 - share) * ((weight * predicted).sum() / weights - disparity_px);
    sigma_px *= std::sqrt(share);
  }

  static float agreement(float residual, float variance) {
    const float q = 1 + residual * residual / (kAgree * kAgree * variance);
    return 1 / (q * q);
  }

  /// Least squares, reweighted by who agrees.
  Patch fit(int x, int y) const {
    const Block& centre = blocks_.at(x, y);
    if (!centre.known()) return {};
    Patch patch;
    patch.u0 = centre.u;
    patch.v0 = centre.v;
    patch.c[0] = centre.disparity_px;
    for (int i = 0; i < kFits; ++i)
      if (!refit(x, y, i == 0, patch)) return {};
    return patch;
  }

  bool refit(int x, int y, bool first, Patch& patch) const {
    Eigen::Matrix<float, 8, 6> sums = Eigen::Matrix<float, 8, 6>::Zero();
    PaddedRow right_sums = PaddedRow::Zero();
    float weights = 0, squares = 0, noise = 0;
    for (int dy = -reach_; dy <= reach_; ++dy) {
      if (y + dy < 0 || y + dy >= blocks_.height_px) continue;
      for (int dx = -reach_; dx <= reach_; ++dx) {
        if (x + dx < 0 || x + dx >= blocks_.width_px) continue;
        const Block& other = blocks_.at(x + dx, y + dy);
        if (!other.known()) continue;
        const PaddedRow row = patch.row(other.u, other.v, scale_);
        const float residual = other.disparity_px - patch.c.dot(row.head<6>());
        float trust =
            window_[static_cast<std::size_t>((dy + reach_) * (2 * reach_ + 1) + dx + reach_)];
        if (first) {
          const float du = other.u - patch.u0, dv = other.v - patch.v0;
          if (std::abs(residual) > kStepPx + kSlope * std::sqrt(du * du + dv * dv)) continue;
        } else {
          trust *= agreement(residual, patch.variance + other.variance);
        }
        const float weight = trust * other.information;
        for (int k = 0; k < 6; ++k) sums.col(k) += (weight * row[k]) * row;
        right_sums += (weight * residual) * row;
        weights += weight;
        squares += weight * residual * residual;
        noise += weight * other.variance;
      }
    }
    if (!(weights > 0)) return false;
    Eigen::Matrix<float, 6, 6> normal = sums.topRows<6>();
    const Coefficients right = right_sums.head<6>();
    normal.diagonal().tail<5>().array() += kRidge * weights;
    const Eigen::LLT<Eigen::Matrix<float, 6, 6>> solver(normal);
    if (solver.info() != Eigen::Success) return false;
    const Coefficients step = solver.solve(right);
    // The residuals that are left, by the normal equations.
    const float left = std::max(squares - step.dot(right), 0.0f) / weights;
    const float relief = std::max(left - noise / weights, 0.0f);
    patch.c += step;
    // Of the centre: how much the fit leaves undetermined, for independent measurements.
    const float undetermined = solver.solve(Coefficients::Unit(0))[0];
    patch.variance = floor_ + relief + independent_px2_ * undetermined;
    return step.allFinite();
  }

  int size_, reach_;
  float scale_;  // windows a pixel
  float independent_px2_, floor_;
  Raster<Block> blocks_;
  Raster<Patch> patches_;
  std::vector<float> window_;
};

}  // namespace

void smoothByPatches(const SmoothingOptions& options, const RefinementOptions& refinement,
                     DisparityMap& map) {
  if (options.reach_blocks == 0) return;
  const Patches patches(options, refinement, map);
  parallelRows(map.disparity_px.height_px, [&](int v) {
    patches.smoothRow(v, map.disparity_px.width_px, map.disparity_px.row(v), map.sigma_px.row(v));
  });
}

}  // namespace softscope
