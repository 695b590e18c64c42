// eval/images/picture_errors.h: PSNR and SSIM of a rendered image.
#pragma once

#include "core/image.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// NaN without evaluated pixels. Infinite PSNR: equal images.
struct PictureErrors {
  double psnr_db = Statistics::kNone;  // over the evaluated pixels, all three channels
  /// The same differences averaged over all pixels of the image, as
  /// in some papers: the value rises with fewer evaluated pixels.
  double psnr_over_all_pixels_db = Statistics::kNone;
  /// Structural similarity of luma (Wang et al. 2004): Gaussian window 11 x 11,
  /// sigma 1.5, K1 0.01, K2 0.03; mean over pixels with a fully evaluated window.
  double ssim = Statistics::kNone;
  double judged_share = Statistics::kNone;  // share of the pixels that may show tissue
};

/// Evaluates pixels that are zero in `ignore` and `not_tissue` (instruments,
/// black borders); empty: all. Throws InputError for different sizes.
PictureErrors pictureErrors(const ColourImage& drawn, const ColourImage& photograph,
                            const Mask& ignore = {}, const Mask& not_tissue = {});

}  // namespace softscope
