// apps/stereo_settings.cpp: a key a field. The bindings name all fields of a struct, so a new field
// without a key doesn't compile.
#include "apps/stereo_settings.h"

namespace softscope {
namespace {

void bindElas(SettingsBinder& binder, ElasOptions& options) {
  auto& [gradient_gain, support_step_px, support_texture, support_uniqueness, support_left_right_px,
         support_window_cells, support_agreement_px, support_min_neighbours,
         support_redundant_cells, prior_sigma_px, prior_weight, left_right_px, speckle_size_px,
         speckle_step_px, gap_width_px, gap_step_px, coarser_levels, coarser_above] = options;
  const std::string at = "stereo.elas.";
  binder.bind(at + "gradient_gain", gradient_gain, "8-bit steps per Sobel unit");
  binder.bind(at + "support_step_px", support_step_px, "grid on which support points are sought");
  binder.bind(at + "support_texture", support_texture, "least mean |gradient| of the window");
  binder.bind(at + "support_uniqueness", support_uniqueness, "best cost over second best, at most");
  binder.bind(at + "support_left_right_px", support_left_right_px, "match returns this close");
  binder.bind(at + "support_window_cells", support_window_cells, "reach of neighbours, grid steps");
  binder.bind(at + "support_agreement_px", support_agreement_px, "neighbours agree to this");
  binder.bind(at + "support_min_neighbours", support_min_neighbours, "so many must agree");
  binder.bind(at + "support_redundant_cells", support_redundant_cells,
              "points between equals this near are left out");
  binder.bind(at + "prior_sigma_px", prior_sigma_px, "how far the surface leaves its triangle");
  binder.bind(at + "prior_weight", prior_weight, "cost of leaving it altogether");
  binder.bind(at + "left_right_px", left_right_px, "left and right disparity agree to this");
  binder.bind(at + "speckle_size_px", speckle_size_px, "smaller islands are removed");
  binder.bind(at + "speckle_step_px", speckle_step_px, "neighbours of an island differ by less");
  binder.bind(at + "gap_width_px", gap_width_px, "gaps up to this are interpolated");
  binder.bind(at + "gap_step_px", gap_step_px, "if both sides differ at most by this");
  binder.bind(at + "coarser_levels", coarser_levels, "half sizes tried where texture is weak");
  binder.bind(at + "coarser_above", coarser_above, "share of unmatched pixels from which they are");
}

void bindRefinement(SettingsBinder& binder, RefinementOptions& options) {
  auto& [iterations, radius_px, highpass_sigma_px, noise_gray, noise_floor_gray, model_sigma_px,
         prior_sigma_px, relaxation, max_difference, max_sigma_px] = options;
  const std::string at = "stereo.refinement.";
  binder.bind(at + "iterations", iterations, "steps of sub-pixel refinement");
  binder.bind(at + "radius_px", radius_px, "window is (2 r + 1)²");
  binder.bind(at + "highpass_sigma_px", highpass_sigma_px, "slower brightness is left out");
  binder.bind(at + "noise_gray", noise_gray, "residual that halves a pixel's weight");
  binder.bind(at + "noise_floor_gray", noise_floor_gray, "noise that a perfect match leaves");
  binder.bind(at + "model_sigma_px", model_sigma_px, "error that no texture removes");
  binder.bind(at + "prior_sigma_px", prior_sigma_px, "trust in the matched disparity");
  binder.bind(at + "relaxation", relaxation, "share of each step taken");
  binder.bind(at + "max_difference", max_difference, "(R - L)² as a share of R² + L², at most");
  binder.bind(at + "max_sigma_px", max_sigma_px, "less certain pixels are dropped");
}

void bindSmoothing(SettingsBinder& binder, SmoothingOptions& options) {
  auto& [block_px, reach_blocks, relief_px] = options;
  const std::string at = "stereo.smoothing.";
  binder.bind(at + "block_px", block_px, "squares averaged; 0: an 80th of the width");
  binder.bind(at + "reach_blocks", reach_blocks, "of a window, to each side; 0: no smoothing");
  binder.bind(at + "relief_px", relief_px, "that tissue has and no patch follows");
}

}  // namespace

void bindStereoOptions(SettingsBinder& binder, StereoOptions& options) {
  auto& [method, disparity_min_px, disparity_max_px, darkest_gray, dark_margin_px, erode_edges_px,
         edge_step_px, border_px, elas, refinement, smoothing, sgbm_block_px] = options;
  const std::string at = "stereo.";
  binder.bind(at + "method", method, "elas or sgbm");
  binder.bind(at + "disparity_min_px", disparity_min_px, "smallest disparity sought");
  binder.bind(at + "disparity_max_px", disparity_max_px, "largest disparity sought");
  binder.bind(at + "darkest_gray", darkest_gray, "darker pixels can't be matched");
  binder.bind(at + "dark_margin_px", dark_margin_px, "nor those this near to them");
  binder.bind(at + "erode_edges_px", erode_edges_px,
              "pixels this near to a depth step are dropped");
  binder.bind(at + "edge_step_px", edge_step_px, "a step: neighbours differ by more than this");
  binder.bind(at + "border_px", border_px, "pixels this near to the border are dropped");
  binder.bind(at + "sgbm_block_px", sgbm_block_px, "block of OpenCV's SGBM");
  bindElas(binder, elas);
  bindRefinement(binder, refinement);
  bindSmoothing(binder, smoothing);
}

}  // namespace softscope
