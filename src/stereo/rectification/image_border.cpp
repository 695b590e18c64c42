#include "stereo/rectification/image_border.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "core/mask_morphology.h"
#include "core/parallel.h"

namespace softscope {
namespace {

// Of the largest channel, which is that of the border in all of it.
constexpr int kAlike = 4;         // a level that went through a codec
constexpr int kAlikeBeside = 16;  // the codec's ringing
constexpr int kBrightest = 127;   // of a border; saturated tissue is brighter
// Squares of 11 x 11: noise of one level leaves none of them even.
constexpr int kBorderReachPx = 5;
constexpr int kEven = 1;      // levels between neighbours
constexpr int kBesidePx = 8;  // a codec's block
constexpr int kCutPx = 3;     // that rectification mixes with black

int largestOf(Rgb8 c) { return std::max({c.red, c.green, c.blue}); }

/// Whether a pixel is not of the border's level, or other than its right neighbour.
bool isSignal(const ColourImage& image, int level, int u, int v) {
  const int here = largestOf(image.at(u, v));
  if (std::abs(here - level) > kAlike) return true;
  const int beside = largestOf(image.at(std::min(u + 1, image.width_px - 1), v));
  // Beside a pixel of another level lies the cut, which that pixel itself marks.
  return std::abs(beside - level) <= kAlike && std::abs(here - beside) > kEven;
}

Raster<std::uint8_t> signal(const ColourImage& image, int level) {
  Raster<std::uint8_t> marks(image.width_px, image.height_px, 0);
  parallelRows(image.height_px, [&](int v) {
    for (int u = 0; u < image.width_px; ++u) marks.at(u, v) = isSignal(image, level, u, v);
  });
  return marks;
}

/// Whether a square around a pixel of one side of the image is without signal, the side being
/// `count` pixels long. at(i, k): pixel i of the side, k pixels inwards. Beyond the image is none.
template <class At>
bool isEvenAt(int count, int depth, const At& at) {
  int even = kBorderReachPx;  // lines of pixels without signal, one after the other
  for (int i = 0; i < count; ++i) {
    bool holds_signal = false;
    for (int k = 0; k <= std::min(kBorderReachPx, depth - 1) && !holds_signal; ++k)
      holds_signal = at(i, k);
    even = holds_signal ? 0 : even + 1;
    if (even > 2 * kBorderReachPx) return true;
  }
  return even + kBorderReachPx > 2 * kBorderReachPx;
}

/// Every border does: an image of tissue alone is told without a look at its inside.
bool beginsAtAnEdge(const ColourImage& image, int level) {
  const int width = image.width_px, height = image.height_px;
  const auto at = [&](int u, int v) { return isSignal(image, level, u, v); };
  return isEvenAt(width, height, [&](int i, int k) { return at(i, k); }) ||
         isEvenAt(width, height, [&](int i, int k) { return at(i, height - 1 - k); }) ||
         isEvenAt(height, width, [&](int i, int k) { return at(k, i); }) ||
         isEvenAt(height, width, [&](int i, int k) { return at(width - 1 - k, i); });
}

/// 1 where the largest channel is further from the level than the limit.
Raster<std::uint8_t> apart(const ColourImage& image, int level, int limit) {
  Raster<std::uint8_t> marks(image.width_px, image.height_px, 0);
  parallelRows(image.height_px, [&](int v) {
    for (int u = 0; u < image.width_px; ++u)
      marks.at(u, v) = std::abs(largestOf(image.at(u, v)) - level) > limit;
  });
  return marks;
}

/// The pixels that are 1 in `open` and connected to the image's edge within it.
Mask connectedToEdge(const Raster<std::uint8_t>& open) {
  const int width = open.width_px, height = open.height_px;
  Mask reached(width, height, 0);
  std::vector<std::pair<int, int>> front;
  const auto reach = [&](int u, int v) {
    if (!open.contains(u, v) || open.at(u, v) == 0 || reached.at(u, v) != 0) return;
    reached.at(u, v) = 1;
    front.emplace_back(u, v);
  };
  for (int u = 0; u < width; ++u) reach(u, 0), reach(u, height - 1);
  for (int v = 0; v < height; ++v) reach(0, v), reach(width - 1, v);
  while (!front.empty()) {
    const auto [u, v] = front.back();
    front.pop_back();
    reach(u - 1, v), reach(u + 1, v), reach(u, v - 1), reach(u, v + 1);
  }
  return reached;
}

std::size_t countOf(const Mask& mask) {
  return mask.size() - static_cast<std::size_t>(
                           std::count(mask.values.begin(), mask.values.end(), std::uint8_t{0}));
}

/// Of that level; empty where there is none.
Mask borderOf(const ColourImage& image, int level) {
  if (!beginsAtAnEdge(image, level)) return {};
  // 1 where the whole square is even; pixels beyond the image count as such.
  Raster<std::uint8_t> core = dilated(signal(image, level), kBorderReachPx);
  for (std::uint8_t& value : core.values) value = value == 0;
  core = connectedToEdge(core);
  if (countOf(core) == 0 || countOf(core) > core.size() * 3 / 4) return {};
  const Raster<std::uint8_t> beside = dilated(core, kBorderReachPx + kBesidePx);
  Raster<std::uint8_t> alike = apart(image, level, kAlikeBeside);
  for (std::size_t i = 0; i < alike.size(); ++i)
    alike.values[i] = core.values[i] != 0 || (alike.values[i] == 0 && beside.values[i] != 0);
  return connectedToEdge(alike);
}

/// Level that most pixels at the edge of the image without `covered` have; 0 where that is too
/// bright, or that of few.
int levelOfEdge(const ColourImage& image, const Mask& covered) {
  constexpr int kFew = 10;  // a tenth; textured tissue has none of more than a thirtieth
  std::array<int, 256> counts{};
  const auto isOut = [&](int u, int v) {
    return !image.contains(u, v) || (!covered.empty() && covered.at(u, v) != 0);
  };
  const auto count = [&](int u, int v) {
    if (!isOut(u, v) && (isOut(u - 1, v) || isOut(u + 1, v) || isOut(u, v - 1) || isOut(u, v + 1)))
      ++counts[static_cast<std::size_t>(largestOf(image.at(u, v)))];
  };
  for (int v = 0; v < image.height_px; ++v) {
    const bool is_inside = covered.empty() && v > 0 && v < image.height_px - 1;
    for (int u = 0; u < image.width_px; u += is_inside ? std::max(1, image.width_px - 1) : 1)
      count(u, v);
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  const auto level = static_cast<int>(most - counts.begin());
  const int all = std::accumulate(counts.begin(), counts.end(), 0);
  return level <= kBrightest && kFew * *most > all ? level : 0;
}

}  // namespace

Mask findBorder(const ColourImage& image) {
  const Mask black = borderOf(image, 0);
  const Mask covered = black.empty() ? black : dilated(black, kCutPx);
  const int level = levelOfEdge(image, covered);
  if (level <= kAlike) return black;
  ColourImage inside = image;
  const auto grey = static_cast<std::uint8_t>(level);
  for (std::size_t i = 0; i < covered.size(); ++i)
    if (covered.values[i] != 0) inside.values[i] = {grey, grey, grey};
  const Mask border = borderOf(inside, level);
  return countOf(border) > countOf(covered) ? border : black;
}

ViewMasks pixelsToIgnore(const StereoPair& rectified, const Rectifier& rectifier,
                         bool find_border) {
  ViewMasks ignored = rectifier.mixedWithOutside();
  if (!find_border) return ignored;
  parallelInvoke([&] { ignored.left = united(ignored.left, findBorder(rectified.left)); },
                 [&] { ignored.right = united(ignored.right, findBorder(rectified.right)); });
  return ignored;
}

}  // namespace softscope
