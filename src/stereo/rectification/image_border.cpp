#include "stereo/rectification/image_border.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/mask_morphology.h"
#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kBlack = 4;  // largest channel: black that went through a codec
constexpr int kDark = 16;  // largest channel beside it: the codec's ringing
// Squares of 11 x 11: noise of one level leaves none of them even.
constexpr int kBorderReachPx = 5;
constexpr int kEven = 1;      // levels between neighbours
constexpr int kBesidePx = 8;  // a codec's block

int largestOf(Rgb8 c) { return std::max({c.red, c.green, c.blue}); }

/// Whether the largest channel is above kBlack, or other than its right neighbour's.
bool isSignal(const ColourImage& image, int u, int v) {
  const int here = largestOf(image.at(u, v));
  if (here > kBlack) return true;
  const int beside = largestOf(image.at(std::min(u + 1, image.width_px - 1), v));
  // Beside a bright pixel lies the cut, which the pixel itself marks.
  return beside <= kBlack && std::abs(here - beside) > kEven;
}

Raster<std::uint8_t> signal(const ColourImage& image) {
  Raster<std::uint8_t> marks(image.width_px, image.height_px, 0);
  parallelRows(image.height_px, [&](int v) {
    for (int u = 0; u < image.width_px; ++u) marks.at(u, v) = isSignal(image, u, v);
  });
  return marks;
}

/// Whether a square around a pixel of one side of the image is black, the side being `count` pixels
/// long. at(i, k): pixel i of the side, k pixels inwards. Beyond the image all is black.
template <class At>
bool isBlackAt(int count, int depth, const At& at) {
  int black = kBorderReachPx;  // lines of pixels without signal, one after the other
  for (int i = 0; i < count; ++i) {
    bool holds_signal = false;
    for (int k = 0; k <= std::min(kBorderReachPx, depth - 1) && !holds_signal; ++k)
      holds_signal = at(i, k);
    black = holds_signal ? 0 : black + 1;
    if (black > 2 * kBorderReachPx) return true;
  }
  return black + kBorderReachPx > 2 * kBorderReachPx;
}

/// Every border does: an image of tissue alone is told without a look at its inside.
bool beginsAtAnEdge(const ColourImage& image) {
  const int width = image.width_px, height = image.height_px;
  const auto at = [&](int u, int v) { return isSignal(image, u, v); };
  return isBlackAt(width, height, [&](int i, int k) { return at(i, k); }) ||
         isBlackAt(width, height, [&](int i, int k) { return at(i, height - 1 - k); }) ||
         isBlackAt(height, width, [&](int i, int k) { return at(k, i); }) ||
         isBlackAt(height, width, [&](int i, int k) { return at(width - 1 - k, i); });
}

/// 1 where the largest channel is above the limit.
Raster<std::uint8_t> above(const ColourImage& image, int limit) {
  Raster<std::uint8_t> marks(image.width_px, image.height_px, 0);
  parallelRows(image.height_px, [&](int v) {
    for (int u = 0; u < image.width_px; ++u) {
      marks.at(u, v) = largestOf(image.at(u, v)) > limit;
    }
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

}  // namespace

Mask findBlackBorder(const ColourImage& image) {
  if (!beginsAtAnEdge(image)) return {};
  // 1 where the whole square is black; pixels beyond the image count as black.
  Raster<std::uint8_t> core = dilated(signal(image), kBorderReachPx);
  for (std::uint8_t& value : core.values) value = value == 0;
  core = connectedToEdge(core);
  if (countOf(core) == 0 || countOf(core) > core.size() * 3 / 4) return {};
  const Raster<std::uint8_t> beside = dilated(core, kBorderReachPx + kBesidePx);
  Raster<std::uint8_t> dark = above(image, kDark);
  for (std::size_t i = 0; i < dark.size(); ++i)
    dark.values[i] = core.values[i] != 0 || (dark.values[i] == 0 && beside.values[i] != 0);
  return connectedToEdge(dark);
}

ViewMasks pixelsToIgnore(const StereoPair& rectified, const Rectifier& rectifier,
                         bool find_border) {
  ViewMasks ignored = rectifier.mixedWithOutside();
  if (!find_border) return ignored;
  parallelInvoke([&] { ignored.left = united(ignored.left, findBlackBorder(rectified.left)); },
                 [&] { ignored.right = united(ignored.right, findBlackBorder(rectified.right)); });
  return ignored;
}

}  // namespace softscope
