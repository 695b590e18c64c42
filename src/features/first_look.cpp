#include "features/first_look.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "features/look_search.h"

namespace softscope {
namespace {

/// Offset of pixel i of a window from its centre.
Eigen::Vector2d windowOffset(int i) {
  return {i % kLookSidePx - kLookHalfPx, i / kLookSidePx - kLookHalfPx};
}

/// Whether a bilinear sample is inside the image.
bool sampleable(const GrayImage& image, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image.width_px - 1 &&
         pixel.y() < image.height_px - 1;
}

/// Bilinear sample at a position inside the image.
double sampleAt(const GrayImage& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const double across = u - u0, down = v - v0;
  const std::uint8_t* above = image.row(v0) + u0;
  const std::uint8_t* below = above + image.width_px;
  const double first = above[0] + across * (above[1] - above[0]);
  const double second = below[0] + across * (below[1] - below[0]);
  return first + down * (second - first);
}

/// Whether a masked pixel contributes to it.
bool ignoredAt(const Mask& ignore, double u, double v) {
  if (ignore.empty()) return false;
  const std::uint8_t* above = ignore.row(static_cast<int>(v)) + static_cast<int>(u);
  const std::uint8_t* below = above + ignore.width_px;
  return (above[0] | above[1] | below[0] | below[1]) != 0;
}

/// `pixel`: of the full image.
FirstLook::Window takeWindow(const LookPicture& picture, std::size_t level,
                             const Eigen::Vector2d& pixel, const ConnectedSurface* surface) {
  const GrayImage& image = picture.gray[level];
  FirstLook::Window window;
  if (image.width_px < 2 || image.height_px < 2 || !pixel.allFinite()) return window;
  int tissue = 0, counted = 0;
  const int of_level = static_cast<int>(level);
  const Eigen::Vector2d middle(inLevel(pixel.x(), of_level), inLevel(pixel.y(), of_level));
  const Eigen::Vector2d last(image.width_px - 1.001, image.height_px - 1.001);
  for (int i = 0; i < kLookPixels; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const Eigen::Vector2d place = middle + windowOffset(i);
    const Eigen::Vector2d nearest = place.cwiseMax(0).cwiseMin(last);
    window.gray[at] =
        static_cast<std::uint8_t>(std::lround(sampleAt(image, nearest.x(), nearest.y())));
    const bool ignored =
        !sampleable(image, place) || ignoredAt(picture.ignore[level], nearest.x(), nearest.y());
    const bool elsewhere =
        surface != nullptr &&
        !surface->holds({inWhole(place.x(), of_level), inWhole(place.y(), of_level)}, 1 << level);
    window.ignore[at] = ignored || elsewhere;
    tissue += !ignored;
    counted += window.ignore[at] == 0;
  }
  window.taken =
      tissue >= kLeastLookShare * kLookPixels && counted >= FirstLook::kLeastSurface * kLookPixels;
  return window;
}

/// From a level down to the full image, each starting from the previous result; the last one found
/// counts. The full image is searched from `expected` only if it is requested alone.
LookFind findFrom(std::size_t coarsest, const FirstLook& look, const LookPicture& picture,
                  const LookPlace& expected) {
  LookFind find = noFind(expected);
  for (std::size_t level = coarsest + 1; level-- > 0;) {
    if (level == 0 && coarsest > 0 && !find.found) break;
    LookSearch search = searchFrom(placeInLevel(find.place, static_cast<int>(level)));
    const bool found = findWindow(look.windows[level], picture.gray[level], picture.ignore[level],
                                  expected.map, &search);
    addLevel(search, found, static_cast<int>(level), &find);
  }
  return find;
}

}  // namespace

LookPicture::LookPicture(const GrayImage& image, const Mask& hidden) {
  gray[0] = image;
  ignore[0] = hidden;
  for (std::size_t level = 1; level < kLevels; ++level) {
    gray[level] = halve(gray[level - 1]);
    ignore[level] = halvedMask(ignore[level - 1]);
  }
}

FirstLook FirstLook::take(const LookPicture& picture, const Eigen::Vector2d& pixel,
                          const ConnectedSurface* surface) {
  FirstLook look;
  for (std::size_t level = 0; level < LookPicture::kLevels; ++level)
    look.windows[level] = takeWindow(picture, level, pixel, surface);
  return look;
}

FoundLook findLook(const SoughtLook& sought, const LookPicture& picture) {
  const LookPlace expected = placeOf(sought.pixel, sought.image_from_look);
  const LookFind whole = findFrom(0, *sought.look, picture, expected);
  if (whole.found) return foundLook(whole, sought.pixel);
  const LookFind smaller = findFrom(LookPicture::kLevels - 1, *sought.look, picture, expected);
  return foundLook(smaller.found ? smaller : whole, sought.pixel);
}

std::vector<FoundLook> findLooks(const std::vector<SoughtLook>& sought,
                                 const LookPicture& picture) {
  constexpr int kLooksPerTask = 2;
  std::vector<FoundLook> found(sought.size());
  parallelRanges(static_cast<int>(sought.size()), kLooksPerTask, [&](int begin, int end) {
    std::transform(sought.begin() + begin, sought.begin() + end, found.begin() + begin,
                   [&](const SoughtLook& one) { return findLook(one, picture); });
  });
  return found;
}

}  // namespace softscope
