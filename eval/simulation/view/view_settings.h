// eval/simulation/view/view_settings.h: keys, ranges and meanings of the settings of instrument and
// light.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/view/scope_shading.h"
#include "eval/simulation/view/scope_tool.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, ScopeToolOptions& o) {
  v("instrument.radius_mm", o.radius_mm, between(0, 20), "of its shaft, 0.5 or more; 0: none");
  v("instrument.side_deg", o.side_deg, between(-360, 360), "of its shaft; 90: from below");
  v("instrument.reach", o.reach, between(-1, 1), "of its tip: 0 middle, 1 border");
  v("instrument.height_mm", o.height_mm, between(0, 200), "of its tip above the tissue");
  v("instrument.amplitude_mm", o.amplitude_mm, between(0, 50), "to and fro along its shaft");
  v("instrument.period_s", o.period_s, aboveUpTo(0, 1000), "of that motion");
}

template <class Visitor>
void describe(Visitor& v, LightOptions& o) {
  v("light.x_mm", o.x_mm, between(-50, 50), "from the middle between the cameras, to the right");
  v("light.y_mm", o.y_mm, between(-50, 50), "the same, down");
  v("light.z_mm", o.z_mm, between(-50, 50), "the same, forward");
  v("light.beam", o.beam, between(0, 20), "power of the cosine; 0: all round");
  v("light.relief", o.relief, between(0, 3), "how strongly fine bumps bend the light");
}

}  // namespace softscope
