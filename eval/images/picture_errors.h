// eval/images/picture_errors.h: PSNR and SSIM of a rendered image.
#pragma once

#include "core/image.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// NaN where no pixel can be judged. Infinite PSNR: no difference at all.
struct PictureErrors {
  double psnr_db = Statistics::kNone;  // over the judged pixels, all three channels
  /// The same differences averaged over all pixels of the image, judged or not: what some papers
  /// give. It is the higher, the less is judged.
  double psnr_over_all_pixels_db = Statistics::kNone;
  /// Structural similarity of luma (Wang et al. 2004): Gaussian window 11 x 11, sigma 1.5,
  /// K1 0.01, K2 0.03; the mean over the pixels whose whole window is judged.
  double ssim = Statistics::kNone;
  double judged_share = Statistics::kNone;  // of the pixels that may show tissue
};

/// Judges the pixels that `ignore` and `not_tissue` (instruments, black borders) don't mark
/// (non-zero; empty: all). Throws InputError where sizes differ.
PictureErrors pictureErrors(const ColourImage& drawn, const ColourImage& photograph,
                            const Mask& ignore = {}, const Mask& not_tissue = {});

}  // namespace softscope
