// eval/simulation/simulation_settings.h: keys, ranges and meanings of a simulation's settings.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/simulation_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, OrganOptions& o) {
  v("organ.length_mm", o.length_mm, between(10, 500), "of the built-in organ");
  v("organ.cells_per_side", o.cells_per_side, between(4, 400), "n; it has about 6 n² vertices");
  v("organ.lobe_mm", o.lobe_mm, atLeast(0), "height of lobes; at most a tenth of length_mm");
  v("organ.fold_mm", o.fold_mm, atLeast(0), "depth of folds; at most a twentieth of length_mm");
}

template <class Visitor>
void describe(Visitor& v, VesselOptions& o) {
  v("texture.trunk_spacing_mm", o.trunk_spacing_mm, between(2, 200),
    "between neighbouring vessel trunks");
  v("texture.trunk_radius_mm", o.trunk_radius_mm, between(0, 3),
    "of the widest vessel; 0: no vessels");
}

template <class Visitor>
void describe(Visitor& v, TextureOptions& o) {
  v("texture.picture_mm", o.picture_mm, between(2, 2000), "width of the picture on the tissue");
  v("texture.contrast", o.contrast, between(0, 2), "0: one colour, 1: healthy abdomen");
  v("texture.fat", o.fat, between(0, 1), "share of the surface under fat, roughly");
  v("texture.wetness", o.wetness, between(0, 5), "strength of specular highlights");
  v("texture.blood", o.blood, between(0, 1), "share of the surface under fresh blood, roughly");
  describe(v, o.vessels);
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
void describe(Visitor& v, CameraPathOptions& o) {
  v("camera.path", o.path, oneOf({"still", "sweep", "orbit", "jerk"}), "of the scope");
  v("camera.amplitude_mm", o.amplitude_mm, atLeast(0), "of the path; at most distance_mm");
  v("camera.period_s", o.period_s, aboveUpTo(0, 1000), "of the path");
  v("camera.tremor_mm", o.tremor_mm, between(0, 5), "of the hand; 0: off");
  v("camera.distance_mm", o.distance_mm, between(5, 500), "to the tissue");
  v("camera.azimuth_deg", o.azimuth_deg, between(-360, 360), "of the scope");
  v("camera.elevation_deg", o.elevation_deg, between(-90, 90), "of the scope");
}

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

template <class Visitor>
void describe(Visitor& v, SensorOptions& o) {
  v("sensor.exposure", o.exposure, aboveUpTo(0, 20), "factor of the brightness");
  v("sensor.exposure_change", o.exposure_change, fromToBelow(0, 1), "0.2: 20 % up and down");
  v("sensor.exposure_period_s", o.exposure_period_s, aboveUpTo(0, 1000), "of that change");
  v("sensor.vignetting", o.vignetting, between(0, 1), "loss of light in the corners");
  v("sensor.blur_px", o.blur_px, between(0, 20), "standard deviation of the lens");
  v("sensor.shutter", o.shutter, between(0, 1), "share of a frame's time that it is open");
  v("sensor.noise", o.noise, between(0, 0.5), "standard deviation at black; white = 1");
  v("sensor.shot_noise", o.shot_noise, between(0, 0.5), "what light adds to it at white");
}

template <class Visitor>
void describe(Visitor& v, ScopeEventOptions& o) {
  v("event.kind", o.kind, oneOf({"none", "withdraw", "cover", "wipe", "smoke"}),
    "what takes the tissue out of sight");
  v("event.start_s", o.start_s, aboveUpTo(0, 1e4), "first image that shows it");
  v("event.length_s", o.length_s, aboveUpTo(0, 1e4),
    "from the first image that shows it to the last");
  v("event.return_mm", o.return_mm, between(-100, 100),
    "withdraw: the scope returns this far aside");
  v("event.return_deg", o.return_deg, between(-90, 90), "withdraw: and turned about its axis");
}

template <class Visitor>
void describe(Visitor& v, SimulationOptions& o) {
  v("frames_per_second", o.frames_per_second, aboveUpTo(0, 1000), "of the sequence");
  v("seed", o.seed, atLeast(0), "of all random numbers");
  v("track_spacing_px", o.track_spacing_px, between(2, 10000), "between tracked points");
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
