// src/pose/pose_settings.h: keys, ranges and meanings of the settings of the rigid pose.
#pragma once

#include "core/setting_rules.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, RansacOptions& o) {
  v("pose.threshold_mm", o.threshold_mm, above(0), "pairs with a larger residual are outliers");
  v("pose.seed", o.seed, atLeast(0), "of RANSAC's random choices");
}

template <class Visitor>
void describe(Visitor& v, RefinePoseOptions& o) {
  v("pose.refine.iterations", o.iterations, between(0, 1000), "0: the pose is RANSAC's fit");
  v("pose.scope", o.scope, oneOf({"auto", "static", "moving"}), "motion of the scope, where known");
}

}  // namespace softscope
