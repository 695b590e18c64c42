#include "fusion/fusion_options.h"

#include "fusion/fusion_settings.h"

namespace softscope {

void PixelOptions::validate() const { requireAllowed(*this); }
void PointFusionOptions::validate() const { requireAllowed(*this); }
void ColourOptions::validate() const { requireAllowed(*this); }
void InsertionOptions::validate() const { requireAllowed(*this); }
void FusionOptions::validate() const { requireAllowed(*this); }

FusionOptions FusionOptions::paper() {
  FusionOptions options;
  options.points.soft_truncation = false;
  options.points.buried_mm = 0;
  options.points.reference_sigma_mm = 0;
  options.points.node_trust = NodeTrust::kPaper;
  options.points.follow_innovation = false;
  options.colour.compensate_gain = false;
  options.colour.max_weight = 0;
  options.colour.hold_anchors = false;
  options.colour.highlight_level = 256;
  options.colour.brightening_limit = 256;
  options.insertion.confirm = false;
  return options;
}

}  // namespace softscope
