// src/stereo/stereo_settings.h: keys, ranges and meanings of the stereo stage's settings.
#pragma once

#include "core/setting_rules.h"
#include "stereo/stereo_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, ElasOptions& o) {
  v("stereo.elas.gradient_gain", o.gradient_gain, above(0), "8-bit steps per Sobel unit");
  v("stereo.elas.support_step_px", o.support_step_px, atLeast(1), "grid step of support points");
  v("stereo.elas.support_texture", o.support_texture, atLeast(0),
    "least mean gradient magnitude of the window");
  v("stereo.elas.support_uniqueness", o.support_uniqueness, aboveUpTo(0, 1),
    "largest ratio of best to second best cost");
  v("stereo.elas.support_left_right_px", o.support_left_right_px, atLeast(0),
    "largest left-right difference of a support point");
  v("stereo.elas.support_window_cells", o.support_window_cells, atLeast(1),
    "reach of neighbours, in grid steps");
  v("stereo.elas.support_agreement_px", o.support_agreement_px, atLeast(0),
    "largest difference of neighbours that agree");
  v("stereo.elas.support_min_neighbours", o.support_min_neighbours, atLeast(0),
    "least number of neighbours that agree");
  v("stereo.elas.support_redundant_cells", o.support_redundant_cells, atLeast(0),
    "points between equal ones this near are left out");
  v("stereo.elas.prior_sigma_px", o.prior_sigma_px, above(0),
    "standard deviation of the surface about its triangle");
  v("stereo.elas.prior_weight", o.prior_weight, atLeast(0), "cost of leaving the triangle");
  v("stereo.elas.left_right_px", o.left_right_px, atLeast(0),
    "largest difference of left and right disparity");
  v("stereo.elas.speckle_size_px", o.speckle_size_px, atLeast(0), "smaller islands are removed");
  v("stereo.elas.speckle_step_px", o.speckle_step_px, atLeast(0),
    "largest difference of neighbours in one island");
  v("stereo.elas.gap_width_px", o.gap_width_px, atLeast(0), "gaps up to this are interpolated");
  v("stereo.elas.gap_step_px", o.gap_step_px, atLeast(0),
    "largest difference of both sides of an interpolated gap");
  v("stereo.elas.coarser_levels", o.coarser_levels, atLeast(0),
    "half sizes tried where texture is weak");
  v("stereo.elas.coarser_above", o.coarser_above, atLeast(0),
    "share of unmatched pixels from which half sizes are tried");
}

template <class Visitor>
void describe(Visitor& v, RefinementOptions& o) {
  v("stereo.refinement.iterations", o.iterations, atLeast(1), "steps of sub-pixel refinement");
  v("stereo.refinement.radius_px", o.radius_px, between(2, RefinementOptions::kLargestRadiusPx),
    "the window is (2 r + 1)² pixels");
  v("stereo.refinement.highpass_sigma_px", o.highpass_sigma_px, above(0.5),
    "slower changes of brightness are left out");
  v("stereo.refinement.noise_gray", o.noise_gray, above(0),
    "residual that halves a pixel's weight");
  v("stereo.refinement.noise_floor_gray", o.noise_floor_gray, atLeast(0),
    "noise that a perfect match leaves");
  v("stereo.refinement.model_sigma_px", o.model_sigma_px, atLeast(0),
    "error that no texture removes");
  v("stereo.refinement.prior_sigma_px", o.prior_sigma_px, above(0),
    "standard deviation of the matched disparity");
  v("stereo.refinement.relaxation", o.relaxation, fromToBelow(1, 2), "share of each step taken");
  v("stereo.refinement.max_difference", o.max_difference, above(0),
    "largest (R - L)² as a share of R² + L²");
  v("stereo.refinement.max_sigma_px", o.max_sigma_px, above(0),
    "pixels with a larger predicted sigma are dropped");
}

template <class Visitor>
void describe(Visitor& v, SmoothingOptions& o) {
  v("stereo.smoothing.block_px", o.block_px, atLeast(0),
    "side of the averaged squares; 0: an 80th of the width");
  v("stereo.smoothing.reach_blocks", o.reach_blocks, atLeast(0),
    "of a window, to each side; 0: no smoothing");
  v("stereo.smoothing.relief_px", o.relief_px, atLeast(0),
    "relief of tissue that no patch follows");
}

template <class Visitor>
void describe(Visitor& v, StereoOptions& o) {
  v("stereo.method", o.method, oneOf({"elas", "sgbm"}), "disparity by ELAS or OpenCV's SGBM");
  v("stereo.disparity_min_px", o.disparity_min_px, atLeast(0), "smallest disparity sought");
  v("stereo.disparity_max_px", o.disparity_max_px, between(1, StereoOptions::kLargestDisparityPx),
    "largest disparity sought; above disparity_min_px");
  v("stereo.darkest_gray", o.darkest_gray, between(0, 255), "darker pixels are not matched");
  v("stereo.dark_margin_px", o.dark_margin_px, atLeast(0),
    "pixels this near to dark ones are not matched");
  v("stereo.erode_edges_px", o.erode_edges_px, atLeast(0),
    "pixels this near to a depth discontinuity are dropped");
  v("stereo.edge_step_px", o.edge_step_px, above(0),
    "larger differences of neighbours are depth discontinuities");
  v("stereo.border_px", o.border_px, atLeast(0), "pixels this near to the border are dropped");
  v("stereo.sgbm_block_px", o.sgbm_block_px, atLeast(1), "block of OpenCV's SGBM; odd");
  describe(v, o.elas);
  describe(v, o.refinement);
  describe(v, o.smoothing);
}

}  // namespace softscope
