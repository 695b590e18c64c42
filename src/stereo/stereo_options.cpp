#include "stereo/stereo_options.h"

#include "core/error.h"

namespace softscope {
namespace {

void requireAtLeast(const std::string& field, double value, double least) {
  std::ostringstream rule;
  rule << "must be " << least << " or more";
  require(value >= least, field, value, rule.str());
}

void requireAbove(const std::string& field, double value, double bound) {
  std::ostringstream rule;
  rule << "must be above " << bound;
  require(value > bound, field, value, rule.str());
}

}  // namespace

void ElasOptions::validate() const {
  requireAbove("stereo.elas.gradient_gain", gradient_gain, 0);
  requireAtLeast("stereo.elas.support_step_px", support_step_px, 1);
  requireAtLeast("stereo.elas.support_texture", support_texture, 0);
  require(support_uniqueness > 0 && support_uniqueness <= 1, "stereo.elas.support_uniqueness",
          support_uniqueness, "must be above 0 and at most 1");
  requireAtLeast("stereo.elas.support_left_right_px", support_left_right_px, 0);
  requireAtLeast("stereo.elas.support_window_cells", support_window_cells, 1);
  requireAtLeast("stereo.elas.support_agreement_px", support_agreement_px, 0);
  requireAtLeast("stereo.elas.support_min_neighbours", support_min_neighbours, 0);
  requireAtLeast("stereo.elas.support_redundant_cells", support_redundant_cells, 0);
  requireAbove("stereo.elas.prior_sigma_px", prior_sigma_px, 0);
  requireAtLeast("stereo.elas.prior_weight", prior_weight, 0);
  requireAtLeast("stereo.elas.left_right_px", left_right_px, 0);
  requireAtLeast("stereo.elas.speckle_size_px", speckle_size_px, 0);
  requireAtLeast("stereo.elas.speckle_step_px", speckle_step_px, 0);
  requireAtLeast("stereo.elas.gap_width_px", gap_width_px, 0);
  requireAtLeast("stereo.elas.gap_step_px", gap_step_px, 0);
  requireAtLeast("stereo.elas.coarser_levels", coarser_levels, 0);
  requireAtLeast("stereo.elas.coarser_above", coarser_above, 0);
}

void RefinementOptions::validate() const {
  requireAtLeast("stereo.refinement.iterations", iterations, 1);
  require(radius_px >= 2 && radius_px <= kLargestRadiusPx, "stereo.refinement.radius_px", radius_px,
          "must be 2 to 7");
  requireAbove("stereo.refinement.highpass_sigma_px", highpass_sigma_px, 0.5);
  requireAbove("stereo.refinement.noise_gray", noise_gray, 0);
  requireAtLeast("stereo.refinement.noise_floor_gray", noise_floor_gray, 0);
  requireAtLeast("stereo.refinement.model_sigma_px", model_sigma_px, 0);
  requireAbove("stereo.refinement.prior_sigma_px", prior_sigma_px, 0);
  require(relaxation >= 1 && relaxation < 2, "stereo.refinement.relaxation", relaxation,
          "must be at least 1 and below 2");
  requireAbove("stereo.refinement.max_difference", max_difference, 0);
  requireAbove("stereo.refinement.max_sigma_px", max_sigma_px, 0);
}

void SmoothingOptions::validate() const {
  require(block_px == 0 || block_px >= kSmallestBlockPx, "stereo.smoothing.block_px", block_px,
          "must be 0 or at least 4");
  requireAtLeast("stereo.smoothing.reach_blocks", reach_blocks, 0);
  requireAtLeast("stereo.smoothing.relief_px", relief_px, 0);
}

void StereoOptions::validate() const {
  require(method == "elas" || method == "sgbm", "stereo.method", method, "must be elas or sgbm");
  requireAtLeast("stereo.disparity_min_px", disparity_min_px, 0);
  require(disparity_max_px > disparity_min_px && disparity_max_px <= kLargestDisparityPx,
          "stereo.disparity_max_px", disparity_max_px,
          "must be above disparity_min_px and at most 1023");
  require(darkest_gray >= 0 && darkest_gray <= 255, "stereo.darkest_gray", darkest_gray,
          "must be 0 to 255");
  requireAtLeast("stereo.dark_margin_px", dark_margin_px, 0);
  requireAtLeast("stereo.erode_edges_px", erode_edges_px, 0);
  requireAbove("stereo.edge_step_px", edge_step_px, 0);
  requireAtLeast("stereo.border_px", border_px, 0);
  require(sgbm_block_px >= 1 && sgbm_block_px % 2 == 1, "stereo.sgbm_block_px", sgbm_block_px,
          "must be odd and 1 or more");
  elas.validate();
  refinement.validate();
  smoothing.validate();
}

}  // namespace softscope
