// src/pipeline/first_look.h: how a tracked point looked when it was first seen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/image.h"

namespace softscope {

/// The window of the first image around a point; its pixels are numbered row by row.
struct FirstLook {
  static constexpr int kHalfPx = 10;
  static constexpr int kSidePx = 2 * kHalfPx + 1;
  static constexpr int kPixels = kSidePx * kSidePx;

  std::array<std::uint8_t, kPixels> gray{};
  std::array<std::uint8_t, kPixels> ignore{};  // non-zero: no tissue, or a highlight
  std::uint8_t taken = 0;                      // 0: the rest means nothing
  std::array<std::uint8_t, 5> unused{};        // in place of padding: checkpoints hold all bytes

  /// Of the window around `pixel`; bilinear, pixels outside the image are ignored. Not taken where
  /// less than `kLeastShare` of the window is tissue.
  static FirstLook take(const GrayImage& image, const Mask& ignore, const Eigen::Vector2d& pixel);

  static constexpr double kLeastShare = 0.6;
};

/// Where a look is in an image.
struct FoundLook {
  bool found = false;  // false: the rest is as it was asked for
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double correlation = 0;  // of the windows
  double sigma_px = 0;     // predicted standard error along the worst direction
};

/// Looks for it near `pixel`, where the window is expected turned and stretched by
/// `image_from_look`. Inverse compositional Gauss-Newton (Baker and Matthews, IJCV 2004) over six
/// parameters of an affine map; gain and offset of brightness are free. `image` is smooth where it
/// is noisy: bilinear.
FoundLook findLook(const FirstLook& look, const GrayImage& image, const Mask& ignore,
                   const Eigen::Vector2d& pixel, const Eigen::Matrix2d& image_from_look);

}  // namespace softscope
