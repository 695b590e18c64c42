// eval/simulation/tissue/tissue_settings.h: keys, ranges and meanings of the settings of the organ
// and its motion.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/tissue/organ_mesh.h"
#include "eval/simulation/tissue/tissue_deformation.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, OrganOptions& o) {
  v("organ.length_mm", o.length_mm, between(10, 500), "of the built-in organ");
  v("organ.cells_per_side", o.cells_per_side, between(4, 400), "n; it has about 6 n² vertices");
  v("organ.lobe_mm", o.lobe_mm, atLeast(0), "height of lobes; at most a tenth of length_mm");
  v("organ.fold_mm", o.fold_mm, atLeast(0), "depth of folds; at most a twentieth of length_mm");
}

template <class Visitor>
void describe(Visitor& v, DeformationOptions& o) {
  const auto motion = [&v](const char* amplitude_key, const char* period_key, PeriodicMotion& m) {
    v(amplitude_key, m.amplitude_mm, between(0, 20), "0: off");
    v(period_key, m.period_s, aboveUpTo(0, 1000), "of one cycle");
  };
  motion("breathing.amplitude_mm", "breathing.period_s", o.breathing);
  motion("heartbeat.amplitude_mm", "heartbeat.period_s", o.heartbeat);
  motion("push.amplitude_mm", "push.period_s", o.push);
  v("push.kind", o.push_kind, oneOf({"gaussian", "arap"}), "gaussian: let go; arap: it stays");
  v("push.spread_mm", o.push_spread_mm, aboveUpTo(0, 200),
    "standard deviation of the fall-off; at least twice the amplitude");
}

}  // namespace softscope
