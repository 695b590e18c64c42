#include "stereo/images/view_masks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"

namespace softscope {
namespace {

/// Mean of the unmasked pixels of each square, and their number (0: none).
struct FillLevel {
  Raster<float> mean, count;
};

/// Squares of 2 x 2 of a finer image, whose means and counts are those of two functions of u, v.
template <class MeanAt, class CountAt>
FillLevel coarser(int fine_width, int fine_height, const MeanAt& mean_at, const CountAt& count_at) {
  const int width = (fine_width + 1) / 2, height = (fine_height + 1) / 2;
  FillLevel level{Raster<float>(width, height, 0), Raster<float>(width, height, 0)};
  parallelRows(height, [&](int coarse_v) {
    float *mean = level.mean.row(coarse_v), *count = level.count.row(coarse_v);
    for (int v = 2 * coarse_v; v < std::min(2 * coarse_v + 2, fine_height); ++v)
      for (int u = 0; u < fine_width; ++u) {
        mean[u / 2] += count_at(u, v) * mean_at(u, v);
        count[u / 2] += count_at(u, v);
      }
    for (int u = 0; u < width; ++u)
      if (count[u] > 0) mean[u] /= count[u];
  });
  return level;
}

FillLevel coarser(const FillLevel& fine) {
  return coarser(
      fine.mean.width_px, fine.mean.height_px, [&](int u, int v) { return fine.mean.at(u, v); },
      [&](int u, int v) { return fine.count.at(u, v); });
}

FillLevel coarser(const GrayImage& image, const Mask& mask) {
  return coarser(
      image.width_px, image.height_px,
      [&](int u, int v) { return static_cast<float>(image.at(u, v)); },
      [&](int u, int v) { return mask.at(u, v) == 0 ? 1.0f : 0.0f; });
}

bool isFull(const FillLevel& level) {
  return std::all_of(level.count.values.begin(), level.count.values.end(),
                     [](float count) { return count > 0; });
}

/// Bilinear value of the coarser level at a pixel of the finer one.
float interpolate(const Raster<float>& coarse, int u, int v) {
  const float x = std::max(0.5f * static_cast<float>(u) - 0.25f, 0.0f);
  const float y = std::max(0.5f * static_cast<float>(v) - 0.25f, 0.0f);
  const int u0 = static_cast<int>(x), v0 = static_cast<int>(y);
  const int u1 = std::min(u0 + 1, coarse.width_px - 1), v1 = std::min(v0 + 1, coarse.height_px - 1);
  const float fu = x - static_cast<float>(u0), fv = y - static_cast<float>(v0);
  return (1 - fv) * ((1 - fu) * coarse.at(u0, v0) + fu * coarse.at(u1, v0)) +
         fv * ((1 - fu) * coarse.at(u0, v1) + fu * coarse.at(u1, v1));
}

void fillFrom(const Raster<float>& coarse, FillLevel& fine) {
  parallelRows(fine.mean.height_px, [&](int v) {
    for (int u = 0; u < fine.mean.width_px; ++u)
      if (fine.count.at(u, v) == 0) fine.mean.at(u, v) = interpolate(coarse, u, v);
  });
}

}  // namespace

Mask united(const Mask& one, const Mask& other) {
  if (one.empty()) return other;
  if (!other.empty() && !other.sameShape(one))
    throw Error("masks of one view have different sizes");
  Mask both = one;
  for (std::size_t i = 0; i < other.size(); ++i) both.values[i] |= other.values[i];
  return both;
}

void dropMasked(const Mask& mask, Raster<float>* raster) {
  if (!raster->sameShape(mask)) return;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask.values[i] != 0) raster->values[i] = std::numeric_limits<float>::quiet_NaN();
}

GrayImage fillMasked(const GrayImage& image, const Mask& mask) {
  const auto is_seen = [](std::uint8_t masked) { return masked == 0; };
  if (std::all_of(mask.values.begin(), mask.values.end(), is_seen)) return image;
  std::vector<FillLevel> levels{coarser(image, mask)};
  while (!isFull(levels.back())) {
    if (levels.back().mean.size() == 1) return image;
    levels.push_back(coarser(levels.back()));
  }
  for (std::size_t k = levels.size() - 1; k > 0; --k) fillFrom(levels[k].mean, levels[k - 1]);
  GrayImage filled = image;
  parallelRows(image.height_px, [&](int v) {
    for (int u = 0; u < image.width_px; ++u)
      if (mask.at(u, v) != 0)
        filled.at(u, v) = static_cast<std::uint8_t>(std::lround(interpolate(levels[0].mean, u, v)));
  });
  return filled;
}

MatchableViews matchableViews(const GrayImage& left, const GrayImage& right,
                              const ViewMasks& ignored) {
  MatchableViews views{{}, {}, ignored};
  parallelInvoke([&] { views.left = fillMasked(left, ignored.left); },
                 [&] { views.right = fillMasked(right, ignored.right); });
  return views;
}

}  // namespace softscope
