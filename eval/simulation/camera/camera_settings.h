// eval/simulation/camera/camera_settings.h: keys, ranges and meanings of the settings of camera
// path, events and sensor.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/camera/camera_path.h"
#include "eval/simulation/camera/scope_event.h"
#include "eval/simulation/camera/sensor.h"

namespace softscope {

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
    "event that hides the tissue");
  v("event.start_s", o.start_s, aboveUpTo(0, 1e4), "first image that shows it");
  v("event.length_s", o.length_s, aboveUpTo(0, 1e4),
    "from the first image that shows it to the last");
  v("event.return_mm", o.return_mm, between(-100, 100),
    "withdraw: the scope returns this far aside");
  v("event.return_deg", o.return_deg, between(-90, 90), "withdraw: and turned about its axis");
}

}  // namespace softscope
