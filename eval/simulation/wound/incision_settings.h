// eval/simulation/wound/incision_settings.h: keys, ranges and meanings of the settings of a cut.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/wound/incision.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, CutOptions& o) {
  v("cut.length_mm", o.length_mm, between(0, 200), "along the surface, 3 or more; 0: no cut");
  v("cut.depth_mm", o.depth_mm, between(0.5, 100), "in its middle");
  v("cut.opening_mm", o.opening_mm, atLeast(0),
    "between the lips in the middle, at last; at most half of length_mm");
  v("cut.x_mm", o.x_mm, between(-500, 500),
    "of its middle, from that of the first image, to the right");
  v("cut.y_mm", o.y_mm, between(-500, 500), "the same, down");
  v("cut.angle_deg", o.angle_deg, between(-360, 360), "of its direction there: 0 right, 90 down");
  v("cut.start_s", o.start_s, between(0, 1e5), "closed and invisible until then");
  v("cut.duration_s", o.duration_s, aboveUpTo(0, 1e5), "to open");
}

}  // namespace softscope
