#include "pipeline/reconstruction_options.h"

#include "core/error.h"

namespace softscope {

void GateOptions::validate() const {
  require(min_coverage >= 0 && min_coverage <= 1, "gate.min_coverage", min_coverage,
          "must be 0 to 1");
  require(max_residual_mm > 0, "gate.max_residual_mm", max_residual_mm, "must be above 0");
  require(min_explained >= 0 && min_explained <= 1, "gate.min_explained", min_explained,
          "must be 0 to 1");
  require(min_confidence >= 0 && min_confidence <= 1, "gate.min_confidence", min_confidence,
          "must be 0 to 1");
  require(max_key_views >= 1, "gate.max_key_views", max_key_views, "must be 1 or more");
  require(key_view_step_mm > 0, "gate.key_view_step_mm", key_view_step_mm, "must be above 0");
  require(key_view_step_deg > 0, "gate.key_view_step_deg", key_view_step_deg, "must be above 0");
}

ReconstructionOptions ReconstructionOptions::paper() {
  ReconstructionOptions options;
  options.deform = DeformOptions::paper();
  options.fusion = FusionOptions::paper();
  options.refine_pose.iterations = 0;
  return options;
}

void ReconstructionOptions::validate() const {
  depth.validate();
  require(tissue.margin_px >= 0 && tissue.margin_px <= 100, "tissue.margin_px", tissue.margin_px,
          "must be 0 to 100");
  tissue.highlights.validate();
  tissue.instruments.validate();
  model_view.validate();
  matcher.validate();
  lift.validate();
  pose.validate();
  refine_pose.validate();
  graph.validate();
  deform.validate();
  fusion.validate();
  gate.validate();
}

}  // namespace softscope
