#include "fusion/fusion_options.h"

#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

void requirePositive(double value, const std::string& field) {
  require(value > 0 && std::isfinite(value), field, value, "must be above 0 and finite");
}

void requireNotNegative(double value, const std::string& field) {
  require(value >= 0 && std::isfinite(value), field, value, "must be finite and can't be negative");
}

void requireAngle(double value, const std::string& field) {
  require(value > 0 && value <= 90, field, value, "must be above 0 and at most 90");
}

}  // namespace

void PixelOptions::validate() const {
  requirePositive(max_depth_mm, "fusion.pixels.max_depth_mm");
  requirePositive(max_sigma_mm, "fusion.pixels.max_sigma_mm");
  requirePositive(edge_step, "fusion.pixels.edge_step");
  require(edge_radius_px >= 0 && edge_radius_px <= 16, "fusion.pixels.edge_radius_px",
          edge_radius_px, "must be 0 to 16");
  require(min_cosine >= 0.01 && min_cosine < 1, "fusion.pixels.min_cosine", min_cosine,
          "must be at least 0.01 and below 1");
}

void VisibilityOptions::validate() const {
  requirePositive(max_distance_mm, "fusion.visibility.max_distance_mm");
  requireAngle(max_angle_deg, "fusion.visibility.max_angle_deg");
  requirePositive(occlusion_mm, "fusion.visibility.occlusion_mm");
  require(occlusion_cell_px >= 1 && occlusion_cell_px <= 64, "fusion.visibility.occlusion_cell_px",
          occlusion_cell_px, "must be 1 to 64");
}

void PointFusionOptions::validate() const {
  requirePositive(truncation_mm, "fusion.points.truncation_mm");
  require(max_weight >= 1 && std::isfinite(max_weight), "fusion.points.max_weight", max_weight,
          "must be finite and 1 or more");
  requireNotNegative(reference_sigma_mm, "fusion.points.reference_sigma_mm");
  requirePositive(max_measurement_weight, "fusion.points.max_measurement_weight");
  requirePositive(node_spacing_mm, "fusion.points.node_spacing_mm");
  requireNotNegative(warp_sigma_mm, "fusion.points.warp_sigma_mm");
  require(buried_mm >= 0, "fusion.points.buried_mm", buried_mm, "can't be negative");
  require(contradiction_loss >= 0 && contradiction_loss <= 1, "fusion.points.contradiction_loss",
          contradiction_loss, "must be 0 to 1");
  requireNotNegative(confirmed_weight, "fusion.points.confirmed_weight");
}

void ColourOptions::validate() const {
  requirePositive(reference_distance_mm, "fusion.colour.reference_distance_mm");
  require(gamma >= 1 && gamma <= 3, "fusion.colour.gamma", gamma, "must be 1 to 3");
  requireNotNegative(max_weight, "fusion.colour.max_weight");
  requireNotNegative(anchor_weight, "fusion.colour.anchor_weight");
  require(highlight_level >= 1 && highlight_level <= 256, "fusion.colour.highlight_level",
          highlight_level, "must be 1 to 256 (256 = never)");
  require(brightening_limit >= 1 && brightening_limit <= 256, "fusion.colour.brightening_limit",
          brightening_limit, "must be 1 to 256 (256 = never)");
}

void InsertionOptions::validate() const {
  require(spacing_mm >= 0.01 && std::isfinite(spacing_mm), "fusion.insertion.spacing_mm",
          spacing_mm, "must be finite and 0.01 or more");
  requirePositive(max_sigma_mm, "fusion.insertion.max_sigma_mm");
  requirePositive(band_mm, "fusion.insertion.band_mm");
}

void DensityOptions::validate() const {
  require(cell_mm >= 0.01 && std::isfinite(cell_mm), "fusion.density.cell_mm", cell_mm,
          "must be finite and 0.01 or more");
  requireAngle(max_angle_deg, "fusion.density.max_angle_deg");
}

FusionOptions FusionOptions::paper() {
  FusionOptions options;
  options.points.soft_truncation = false;
  options.points.buried_mm = 0;
  options.points.reference_sigma_mm = 0;
  options.points.node_trust = NodeTrust::kPaper;
  options.points.follow_innovation = false;
  options.colour.compensate_gain = false;
  options.colour.max_weight = 0;
  options.colour.anchor_weight = 0;
  options.colour.highlight_level = 256;
  options.colour.brightening_limit = 256;
  options.insertion.confirm = false;
  return options;
}

void FusionOptions::validate() const {
  pixels.validate();
  visibility.validate();
  points.validate();
  colour.validate();
  insertion.validate();
  density.validate();
}

}  // namespace softscope
