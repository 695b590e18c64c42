// src/pose/pose_settings.h: keys, ranges and meanings of the settings of the rigid pose.
#pragma once

#include "core/setting_rules.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, RansacOptions& o) {
  v("pose.threshold_mm", o.threshold_mm, above(0), "pairs with a larger residual are outliers");
  v("pose.confidence", o.confidence, inside(0, 1), "that one trial drew inliers only");
  v("pose.max_trials", o.max_trials, atLeast(1), "of RANSAC");
  v("pose.refits", o.refits, atLeast(1), "fits to all inliers");
  v("pose.min_inliers", o.min_inliers, atLeast(3), "fewer inliers give no pose");
  v("pose.min_share", o.min_share, between(0, 1), "least share of inliers among the pairs");
  v("pose.min_spread_mm", o.min_spread_mm, above(0), "of the inliers across their line");
  v("pose.seed", o.seed, atLeast(0), "of RANSAC's random choices");
}

template <class Visitor>
void describe(Visitor& v, RefinePoseOptions& o) {
  v("pose.refine.iterations", o.iterations, atLeast(0), "0: the pose is RANSAC's fit");
  v("pose.refine.noise_px", o.noise_px, above(0), "least sigma of a match");
  v("pose.refine.disparity_noise_px", o.disparity_noise_px, above(0), "least sigma of a disparity");
  v("pose.refine.robust_scale", o.robust_scale, above(0),
    "of the median residual; larger ones are moving tissue");
  v("pose.scope", o.scope, oneOf({"auto", "static", "moving"}), "motion of the scope, where known");
  v("pose.significance", o.significance, inside(0, 0.5),
    "probability to take a static scope for a moving one");
}

}  // namespace softscope
