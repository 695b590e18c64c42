#include "pipeline/reconstruction_options.h"

#include "pipeline/reconstruction_settings.h"

namespace softscope {

ReconstructionOptions ReconstructionOptions::paper() {
  ReconstructionOptions options;
  options.deform = DeformOptions::paper();
  options.fusion = FusionOptions::paper();
  options.refine_pose.iterations = 0;
  return options;
}

void ReconstructionOptions::validate() const {
  requireAllowed(*this);
  depth.stereo.validate();  // what one setting demands of another
  matcher.validate();
  graph.validate();
  deform.validate();
}

}  // namespace softscope
