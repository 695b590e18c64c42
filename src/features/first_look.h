// src/features/first_look.h: how a tracked point looked when it was first seen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "features/connected_surface.h"
#include "features/look_formulas.h"

namespace softscope {

/// An image at full, half and quarter size.
struct LookPicture {
  static constexpr int kLevels = kLookLevels;

  LookPicture(const GrayImage& image, const Mask& ignore);

  std::array<GrayImage, kLevels> gray;
  std::array<Mask, kLevels> ignore;
};

/// Windows of the first image around a point, one per image size: at
/// smaller sizes a window covers more tissue, with less noise and blur.
struct FirstLook {
  static constexpr int kHalfPx = kLookHalfPx;
  static constexpr int kPixels = kLookPixels;
  static constexpr double kLeastSurface = 0.35;  // of pixels on its surface

  /// Pixels are numbered row by row.
  struct Window {
    std::array<std::uint8_t, kPixels> gray{};
    std::array<std::uint8_t, kPixels> ignore{};  // non-zero: no tissue, or a highlight
    std::uint8_t taken = 0;                      // 0: the other fields are meaningless
    std::uint8_t unused = 0;                     // padding: checkpoints hold all bytes
  };
  std::array<Window, LookPicture::kLevels> windows;
  std::array<std::uint8_t, 4> unused{};  // padding

  /// Pixels around a point that its windows cover.
  static constexpr int kReachPx = (kHalfPx + 2) << (LookPicture::kLevels - 1);

  /// Windows around `pixel`; bilinear, pixels outside of the image are ignored, and those
  /// off the point's `surface` where it is known. A window is not taken if less than
  /// `kLeastLookShare` of it is tissue, or less than `kLeastSurface` is on the surface.
  static FirstLook take(const LookPicture& picture, const Eigen::Vector2d& pixel,
                        const ConnectedSurface* surface = nullptr);
};

/// Position of a first look in an image.
struct FoundLook {
  bool found = false;  // false: the other fields are as requested
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double correlation = 0;  // of the windows
  double sigma_px = 0;     // predicted standard error along the worst direction
};

/// A first look, and where an image is expected to show it.
struct SoughtLook {
  const FirstLook* look;
  std::int32_t number;  // of the look, as long as that stays
  Eigen::Vector2d pixel;
  Eigen::Matrix2d image_from_look;  // the rotated and stretched window
};

/// Searches near `pixel`: at full size and, without success there, from the smallest
/// size up. Inverse compositional Gauss-Newton (Baker and Matthews, IJCV 2004) over
/// six parameters of an affine map; gain, offset and slope of brightness are free.
FoundLook findLook(const SoughtLook& sought, const LookPicture& picture);
/// In parallel.
std::vector<FoundLook> findLooks(const std::vector<SoughtLook>& sought, const LookPicture& picture);

inline LookPlace placeOf(const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map) {
  return {pixel.x(), pixel.y(), {map(0, 0), map(0, 1), map(1, 0), map(1, 1)}};
}
inline FoundLook foundLook(const LookFind& find, const Eigen::Vector2d& expected) {
  return {find.found, find.found ? Eigen::Vector2d(find.place.u, find.place.v) : expected,
          find.correlation, find.sigma_px};
}

}  // namespace softscope
