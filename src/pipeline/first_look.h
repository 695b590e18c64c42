// src/pipeline/first_look.h: how a tracked point looked when it was first seen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/image.h"

namespace softscope {

/// An image, its half and its quarter.
struct LookPicture {
  static constexpr int kLevels = 3;

  LookPicture(const GrayImage& image, const Mask& ignore);

  std::array<GrayImage, kLevels> gray;
  std::array<Mask, kLevels> ignore;
};

/// The windows of the first image around a point, one of each size of the image: the smaller ones
/// see more of the tissue, through less noise and blur.
struct FirstLook {
  static constexpr int kHalfPx = 10;
  static constexpr int kSidePx = 2 * kHalfPx + 1;
  static constexpr int kPixels = kSidePx * kSidePx;
  static constexpr double kLeastShare = 0.6;

  /// Its pixels are numbered row by row.
  struct Window {
    std::array<std::uint8_t, kPixels> gray{};
    std::array<std::uint8_t, kPixels> ignore{};  // non-zero: no tissue, or a highlight
    std::uint8_t taken = 0;                      // 0: the rest means nothing
    std::uint8_t unused = 0;                     // in place of padding: checkpoints hold all bytes
  };
  std::array<Window, LookPicture::kLevels> windows;
  std::array<std::uint8_t, 12> unused{};  // in place of padding

  /// Of the windows around `pixel`; bilinear, pixels outside the image are ignored. A window is not
  /// taken where less than `kLeastShare` of it is tissue.
  static FirstLook take(const LookPicture& picture, const Eigen::Vector2d& pixel);
};

/// Where a look is in an image.
struct FoundLook {
  bool found = false;  // false: the rest is as it was asked for
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double correlation = 0;  // of the windows
  double sigma_px = 0;     // predicted standard error along the worst direction
};

/// Looks for it near `pixel`, where the window is expected turned and stretched by
/// `image_from_look`: in the whole picture and, where that does not show it, from the smallest
/// picture on. Inverse compositional Gauss-Newton (Baker and Matthews, IJCV 2004) over six
/// parameters of an affine map; gain, offset and slope of brightness are free.
FoundLook findLook(const FirstLook& look, const LookPicture& picture, const Eigen::Vector2d& pixel,
                   const Eigen::Matrix2d& image_from_look);

}  // namespace softscope
