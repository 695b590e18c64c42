// eval/images/picture_errors.cpp: squared differences, and local image moments.
#include "eval/images/picture_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/images/pixel_masks.h"

namespace softscope {
namespace {

constexpr int kReach = 5;  // half size of the window: 11 x 11
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;

using Window = std::array<double, 2 * kReach + 1>;

Window gaussian() {
  Window window{};
  double sum = 0;
  for (int i = -kReach; i <= kReach; ++i)
    sum += window[static_cast<std::size_t>(i + kReach)] = std::exp(-i * i / (2 * kSigma * kSigma));
  for (double& weight : window) weight /= sum;
  return window;
}

/// Weighted sums over a window: of x, y, xx, yy, xy.
using Moments = std::array<double, 5>;

Moments momentsOf(double x, double y) { return {x, y, x * x, y * y, x * y}; }

void addTo(Moments& sum, const Moments& moments, double weight) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * moments[k];
}

double similarity(const Moments& m) {
  const double xx = m[2] - m[0] * m[0], yy = m[3] - m[1] * m[1], xy = m[4] - m[0] * m[1];
  return (2 * m[0] * m[1] + kC1) * (2 * xy + kC2) /
         ((m[0] * m[0] + m[1] * m[1] + kC1) * (xx + yy + kC2));
}

/// Integral image of the ignored pixels.
Raster<int> countIgnored(const Mask& ignore, int width, int height) {
  Raster<int> counts(width + 1, height + 1, 0);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      counts.at(u + 1, v + 1) = counts.at(u, v + 1) + counts.at(u + 1, v) - counts.at(u, v) +
                                (!ignore.empty() && ignore.at(u, v) != 0);
  return counts;
}

bool windowIsJudged(const Raster<int>& ignored, int u, int v) {
  const int left = u - kReach, right = u + kReach + 1, top = v - kReach, bottom = v + kReach + 1;
  return ignored.at(right, bottom) - ignored.at(left, bottom) - ignored.at(right, top) +
             ignored.at(left, top) ==
         0;
}

/// Sums over the window along the rows of both images; the border remains zero and is not used.
Raster<Moments> sumAlongRows(const GrayImage& x, const GrayImage& y, const Window& window) {
  Raster<Moments> sums(x.width_px, x.height_px, Moments{});
  parallelRows(x.height_px, [&](int v) {
    std::vector<Moments> row(static_cast<std::size_t>(x.width_px));
    for (int u = 0; u < x.width_px; ++u)
      row[static_cast<std::size_t>(u)] = momentsOf(x.at(u, v), y.at(u, v));
    for (int u = kReach; u < x.width_px - kReach; ++u)
      for (int i = -kReach; i <= kReach; ++i)
        addTo(sums.at(u, v), row[static_cast<std::size_t>(u + i)],
              window[static_cast<std::size_t>(i + kReach)]);
  });
  return sums;
}

double meanSimilarity(const GrayImage& x, const GrayImage& y, const Mask& ignore) {
  const Window window = gaussian();
  const Raster<Moments> rows = sumAlongRows(x, y, window);
  const Raster<int> ignored = countIgnored(ignore, x.width_px, x.height_px);
  std::vector<double> sums(static_cast<std::size_t>(x.height_px), 0);
  std::vector<double> counts(sums.size(), 0);
  parallelRows(x.height_px, [&](int v) {
    if (v < kReach || v >= x.height_px - kReach) return;
    for (int u = kReach; u < x.width_px - kReach; ++u) {
      if (!windowIsJudged(ignored, u, v)) continue;
      Moments moments{};
      for (int i = -kReach; i <= kReach; ++i)
        addTo(moments, rows.at(u, v + i), window[static_cast<std::size_t>(i + kReach)]);
      sums[static_cast<std::size_t>(v)] += similarity(moments);
      counts[static_cast<std::size_t>(v)] += 1;
    }
  });
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < sums.size(); ++v) {
    sum += sums[v];
    count += counts[v];
  }
  return count == 0 ? Statistics::kNone : sum / count;
}

double squared(int a, int b) { return static_cast<double>((a - b) * (a - b)); }

double decibels(double mean_square) { return 10 * std::log10(255.0 * 255.0 / mean_square); }

}  // namespace

PictureErrors pictureErrors(const ColourImage& drawn, const ColourImage& photograph,
                            const Mask& undrawn, const Mask& not_tissue) {
  const Mask ignore = ignoreEither(undrawn, not_tissue);
  if (!drawn.sameShape(photograph) || (!ignore.empty() && !drawn.sameShape(ignore)))
    throw InputError("an image of " + std::to_string(drawn.width_px) + " x " +
                     std::to_string(drawn.height_px) + " pixels is compared with one of " +
                     std::to_string(photograph.width_px) + " x " +
                     std::to_string(photograph.height_px) + "; give images of one size");
  double squares = 0, judged = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!ignore.empty() && ignore.values[i] != 0) continue;
    const Rgb8 a = drawn.values[i], b = photograph.values[i];
    squares += squared(a.red, b.red) + squared(a.green, b.green) + squared(a.blue, b.blue);
    judged += 1;
  }
  PictureErrors errors;
  if (drawn.empty()) return errors;
  const auto dark = std::count_if(not_tissue.values.begin(), not_tissue.values.end(),
                                  [](std::uint8_t mark) { return mark != 0; });
  const double tissue = static_cast<double>(drawn.size()) - static_cast<double>(dark);
  if (tissue > 0) errors.judged_share = judged / tissue;
  if (judged == 0) return errors;
  errors.psnr_db = decibels(squares / (3 * judged));
  errors.psnr_over_all_pixels_db = decibels(squares / (3 * static_cast<double>(drawn.size())));
  errors.ssim = meanSimilarity(toGray(drawn), toGray(photograph), ignore);
  return errors;
}

}  // namespace softscope
