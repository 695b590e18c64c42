// eval/simulation/sequence/simulation_settings.h: keys, ranges and meanings of a simulation's
// settings.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/camera/camera_settings.h"
#include "eval/simulation/sequence/simulation_options.h"
#include "eval/simulation/texture/texture_settings.h"
#include "eval/simulation/tissue/tissue_settings.h"
#include "eval/simulation/view/view_settings.h"
#include "eval/simulation/wound/incision_settings.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, ScopeOptions& o) {
  v("scope.width_px", o.width_px, between(32, 8192), "of the images");
  v("scope.height_px", o.height_px, between(32, 8192), "of the images");
  v("scope.focal_px", o.focal_px, atLeast(0), "0.1 to 20 widths; 0: 0.875 of the width");
  v("scope.cx_px", o.cx_px, anyNumber(), "below the width; negative: the middle");
  v("scope.cy_px", o.cy_px, anyNumber(), "below the height; negative: the middle");
  v("scope.baseline_mm", o.baseline_mm, between(0.5, 50), "between the cameras");
  v("scope.k1", o.k1, anyNumber(), "lens distortion, OpenCV's; the images are raw then");
  v("scope.k2", o.k2, anyNumber(), "lens distortion");
  v("scope.p1", o.p1, anyNumber(), "lens distortion");
  v("scope.p2", o.p2, anyNumber(), "lens distortion");
  v("scope.k3", o.k3, anyNumber(), "lens distortion");
  v("scope.row_error_px", o.row_error_px, between(-20, 20), "of the right image, uncalibrated");
  v("scope.roll_error_deg", o.roll_error_deg, between(-5, 5), "of the right image, uncalibrated");
}

template <class Visitor>
void describe(Visitor& v, SimulationOptions& o) {
  v("frames_per_second", o.frames_per_second, aboveUpTo(0, 1000), "of the sequence");
  v("seed", o.seed, atLeast(0), "of all random numbers");
  v("track_spacing_px", o.track_spacing_px, between(2, 10000), "between tracked points");
  v("track_border", o.track_border, between(0, 0.45),
    "share of the first image, at each side, without tracked points");
  v("texture.texel_mm", o.texel_mm, between(0, 10), "0.005 or more; 0: three quarters of a pixel");
  v("smoke", o.smoke, between(0, 3), "0: clear air, 1: half of the contrast");
  describe(v, o.organ);
  describe(v, o.texture);
  describe(v, o.deformation);
  describe(v, o.cut);
  describe(v, o.scope);
  describe(v, o.camera);
  describe(v, o.instrument);
  describe(v, o.event);
  describe(v, o.light);
  describe(v, o.sensor);
}

}  // namespace softscope
