#include "pipeline/tracks/first_look.h"

#include <cmath>

#include "pipeline/tracks/window_search.h"

namespace softscope {
namespace {

/// Position in the full image converted to that of a level with pixels `scale` as wide.
Eigen::Vector2d inLevel(const Eigen::Vector2d& pixel, double scale) {
  return (pixel.array() - (scale - 1) / 2) / scale;
}
Eigen::Vector2d inWhole(const Eigen::Vector2d& pixel, double scale) {
  return pixel.array() * scale + (scale - 1) / 2;
}

/// `scale`: pixels of the full image per pixel of this one.
FirstLook::Window takeWindow(const GrayImage& image, const Mask& ignore,
                             const Eigen::Vector2d& pixel, int scale,
                             const ConnectedSurface* surface) {
  FirstLook::Window window;
  if (image.width_px < 2 || image.height_px < 2 || !pixel.allFinite()) return window;
  int tissue = 0, counted = 0;
  const Eigen::Vector2d last(image.width_px - 1.001, image.height_px - 1.001);
  for (int i = 0; i < FirstLook::kPixels; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const Eigen::Vector2d place = pixel + windowOffset(i);
    const Eigen::Vector2d nearest = place.cwiseMax(0).cwiseMin(last);
    window.gray[at] =
        static_cast<std::uint8_t>(std::lround(sampleAt(image, nearest.x(), nearest.y())));
    const bool ignored = !sampleable(image, place) || ignoredAt(ignore, nearest.x(), nearest.y());
    const bool elsewhere = surface != nullptr && !surface->holds(inWhole(place, scale), scale);
    window.ignore[at] = ignored || elsewhere;
    tissue += !ignored;
    counted += window.ignore[at] == 0;
  }
  window.taken = tissue >= FirstLook::kLeastShare * FirstLook::kPixels &&
                 counted >= FirstLook::kLeastSurface * FirstLook::kPixels;
  return window;
}

/// Finds a reference window near `pixel`, as findLook() does.
struct FirstLookFinder {
  const FirstLook& look;
  const LookPicture& picture;
  const Eigen::Vector2d& pixel;
  const Eigen::Matrix2d& image_from_look;

  FoundLook nothing() const {
    FoundLook found;
    found.pixel = pixel;
    return found;
  }

  /// Whether the window of half size, too uncertain to count, confirms that of a
  /// quarter: that one covers much tissue, which rarely moves as one.
  static bool agrees(const LookSearch& search, const Eigen::Vector2d& coarser) {
    constexpr double kFarthestPx = 0.5;
    return search.converged && (search.pixel - coarser).norm() <= kFarthestPx;
  }

  /// From a level down to the full image, each starting from the
  /// previous result; the last one found counts. The full image
  /// is searched from `pixel` only if it is requested alone.
  FoundLook findFrom(std::size_t coarsest) const {
    FoundLook result = nothing();
    Eigen::Matrix2d map = image_from_look;
    for (std::size_t level = coarsest + 1; level-- > 0;) {
      if (level == 0 && coarsest > 0 && !result.found) break;
      const double scale = 1 << level;
      LookSearch search{inLevel(result.pixel, scale), map};
      const bool found = findWindow(look.windows[level], picture.gray[level], picture.ignore[level],
                                    image_from_look, &search);
      if (!found && level == 1 && !agrees(search, inLevel(result.pixel, scale)))
        result.found = false;
      if (found || !result.found) {
        result.correlation = search.correlation;
        result.sigma_px = search.sigma_px * scale;
      }
      if (!found) continue;
      result.found = true;
      result.pixel = inWhole(search.pixel, scale);
      map = search.map;
    }
    return result;
  }
};

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
    look.windows[level] = takeWindow(picture.gray[level], picture.ignore[level],
                                     inLevel(pixel, 1 << level), 1 << level, surface);
  return look;
}

FoundLook findLook(const FirstLook& look, const LookPicture& picture, const Eigen::Vector2d& pixel,
                   const Eigen::Matrix2d& image_from_look) {
  const FirstLookFinder finder{look, picture, pixel, image_from_look};
  if (!pixel.allFinite() || !image_from_look.allFinite()) return finder.nothing();
  const FoundLook whole = finder.findFrom(0);
  if (whole.found) return whole;
  const FoundLook smaller = finder.findFrom(LookPicture::kLevels - 1);
  return smaller.found ? smaller : whole;
}

}  // namespace softscope
