// src/stereo/refinement/pyramid.h: disparities of the half size, in the pixels of the full size.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Halving again is useful if the last one matched a quarter of the unmatched
/// pixels; true for weak texture, not for pixels of one camera only.
constexpr double kWorthHalving = 0.75;

/// Whether half the size is worth a trial, after a level left
/// the share `unmatched` and twice its size `finer_unmatched`.
inline bool isHalvingWorth(const ElasOptions& elas, double unmatched, double finer_unmatched) {
  return unmatched > elas.coarser_above && unmatched < kWorthHalving * finer_unmatched;
}

/// The same search at half the size.
inline StereoOptions halved(StereoOptions options) {
  options.disparity_min_px /= 2;
  options.disparity_max_px = (options.disparity_max_px + 1) / 2;
  options.dark_margin_px = (options.dark_margin_px + 1) / 2;
  options.elas.speckle_size_px /= 4;
  ++options.refinement.halvings;
  return options;
}

/// For unmeasured pixels of `fine`, takes the disparity of the half-size map, in pixels of the fine
/// image, interpolated between four measured pixels of one surface; its standard error doubles.
void fillFromHalf(const DisparityMap& half, DisparityMap& fine);

}  // namespace softscope
