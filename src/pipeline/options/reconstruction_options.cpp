#include "pipeline/options/reconstruction_options.h"

#include <algorithm>

#include "pipeline/options/reconstruction_settings.h"

namespace softscope {

ReconstructionOptions ReconstructionOptions::paper() {
  ReconstructionOptions options;
  options.deform = DeformOptions::paper();
  options.fusion = FusionOptions::paper();
  options.refine_pose.iterations = 0;
  return options;
}

ReconstructionOptions withSharedQuantities(ReconstructionOptions options) {
  options.model_view.point_spacing_mm = options.fusion.insertion.spacing_mm;
  options.fusion.density.cell_mm = options.fusion.insertion.spacing_mm;
  options.fusion.points.node_spacing_mm = options.graph.node_spacing_mm;
  options.graph.cell_mm = std::min(options.graph.cell_mm, options.graph.node_spacing_mm / 2);
  return options;
}

void FrameDepthOptions::validate() const {
  requireAllowed(*this);
  stereo.validate();
}

void ReconstructionOptions::validate() const {
  requireAllowed(*this);
  depth.stereo.validate();  // constraints between settings
}

}  // namespace softscope
