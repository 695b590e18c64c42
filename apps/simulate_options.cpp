// apps/simulate_options.cpp: the keys of a scenario.
#include "apps/simulate_options.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "io/nearest_name.h"
#include "io/text_lines.h"

namespace softscope {
namespace {

void bindOrgan(SettingsBinder& binder, SimulateOptions& options) {
  OrganOptions& organ = options.simulation.organ;
  binder.bind("organ.mesh", options.organ, "builtin, or a mesh file (STL, PLY, OBJ, VTP)");
  binder.bind("organ.unit_mm", options.organ_unit_mm, "of a mesh file: 1000 for metres");
  binder.bind("organ.length_mm", organ.length_mm, "of the built-in organ");
  binder.bind("organ.cells_per_side", organ.cells_per_side, "n; it has about 6 n^2 vertices");
  binder.bind("organ.lobe_mm", organ.lobe_mm, "how far lobes stand out");
  binder.bind("organ.fold_mm", organ.fold_mm, "how deep folds are");
}

void bindTexture(SettingsBinder& binder, SimulateOptions& options) {
  TextureOptions& texture = options.simulation.texture;
  binder.bind("texture.picture", options.texture, "a photograph; empty: procedural tissue");
  binder.bind("texture.picture_mm", texture.picture_mm, "width of the picture on the tissue");
  binder.bind("texture.contrast", texture.contrast, "0: one colour, 1: healthy abdomen");
  binder.bind("texture.fat", texture.fat, "share of the surface under fat, roughly");
  binder.bind("texture.wetness", texture.wetness, "strength of highlights");
  binder.bind("texture.blood", texture.blood, "share of the surface under fresh blood, roughly");
  binder.bind("texture.trunk_spacing_mm", texture.vessels.trunk_spacing_mm,
              "between neighbouring vessel trunks");
  binder.bind("texture.trunk_radius_mm", texture.vessels.trunk_radius_mm,
              "of the widest vessel; 0: no vessels");
  binder.bind("texture.texel_mm", options.simulation.texel_mm, "0: three quarters of a pixel");
}

void bindMotion(SettingsBinder& binder, const std::string& name, PeriodicMotion& motion) {
  binder.bind(name + ".amplitude_mm", motion.amplitude_mm, "0: off");
  binder.bind(name + ".period_s", motion.period_s, "");
}

void bindDeformation(SettingsBinder& binder, DeformationOptions& deformation) {
  bindMotion(binder, "breathing", deformation.breathing);
  bindMotion(binder, "heartbeat", deformation.heartbeat);
  bindMotion(binder, "push", deformation.push);
  binder.bind("push.kind", deformation.push_kind, "gaussian (let go), or arap (it stays)");
  binder.bind("push.spread_mm", deformation.push_spread_mm, "standard deviation of the fall-off");
}

void bindCut(SettingsBinder& binder, CutOptions& cut) {
  binder.bind("cut.length_mm", cut.length_mm, "along the surface; 0: no cut");
  binder.bind("cut.depth_mm", cut.depth_mm, "in its middle");
  binder.bind("cut.opening_mm", cut.opening_mm, "between the lips in the middle, at last");
  binder.bind("cut.x_mm", cut.x_mm, "of its middle, from that of the first picture, right");
  binder.bind("cut.y_mm", cut.y_mm, "down");
  binder.bind("cut.angle_deg", cut.angle_deg, "of its direction there: 0 right, 90 down");
  binder.bind("cut.start_s", cut.start_s, "closed, and not to be seen, until then");
  binder.bind("cut.duration_s", cut.duration_s, "to open");
}

void bindScope(SettingsBinder& binder, ScopeOptions& scope) {
  binder.bind("scope.width_px", scope.width_px, "");
  binder.bind("scope.height_px", scope.height_px, "");
  binder.bind("scope.focal_px", scope.focal_px, "0: 0.875 of the width");
  binder.bind("scope.cx_px", scope.cx_px, "negative: the middle");
  binder.bind("scope.cy_px", scope.cy_px, "negative: the middle");
  binder.bind("scope.baseline_mm", scope.baseline_mm, "between the cameras");
  binder.bind("scope.k1", scope.k1, "lens distortion, OpenCV's; the pictures are raw then");
  binder.bind("scope.k2", scope.k2, "");
  binder.bind("scope.p1", scope.p1, "");
  binder.bind("scope.p2", scope.p2, "");
  binder.bind("scope.k3", scope.k3, "");
  binder.bind("scope.row_error_px", scope.row_error_px, "of the right picture, uncalibrated");
  binder.bind("scope.roll_error_deg", scope.roll_error_deg, "of the right picture, uncalibrated");
}

void bindCamera(SettingsBinder& binder, CameraPathOptions& camera) {
  binder.bind("camera.path", camera.path, "still, sweep, orbit or jerk");
  binder.bind("camera.amplitude_mm", camera.amplitude_mm, "of the way");
  binder.bind("camera.period_s", camera.period_s, "");
  binder.bind("camera.tremor_mm", camera.tremor_mm, "of the hand; 0: off");
  binder.bind("camera.distance_mm", camera.distance_mm, "to the tissue");
  binder.bind("camera.azimuth_deg", camera.azimuth_deg, "where the scope comes from");
  binder.bind("camera.elevation_deg", camera.elevation_deg, "");
}

void bindInstrument(SettingsBinder& binder, ScopeToolOptions& instrument) {
  binder.bind("instrument.radius_mm", instrument.radius_mm, "of its shaft; 0: none");
  binder.bind("instrument.side_deg", instrument.side_deg, "where it comes from; 90: from below");
  binder.bind("instrument.reach", instrument.reach, "of its tip: 0 middle, 1 border");
  binder.bind("instrument.height_mm", instrument.height_mm, "of its tip above the tissue");
  binder.bind("instrument.amplitude_mm", instrument.amplitude_mm, "to and fro along its shaft");
  binder.bind("instrument.period_s", instrument.period_s, "");
}

void bindLightAndSensor(SettingsBinder& binder, LightOptions& light, SensorOptions& sensor) {
  binder.bind("light.x_mm", light.x_mm, "from the middle between the cameras, right");
  binder.bind("light.y_mm", light.y_mm, "down");
  binder.bind("light.z_mm", light.z_mm, "forward");
  binder.bind("light.beam", light.beam, "power of the cosine; 0: all round");
  binder.bind("light.relief", light.relief, "how strongly fine bumps bend the light");
  binder.bind("sensor.exposure", sensor.exposure, "");
  binder.bind("sensor.exposure_change", sensor.exposure_change, "0.2: 20 % up and down");
  binder.bind("sensor.exposure_period_s", sensor.exposure_period_s, "");
  binder.bind("sensor.vignetting", sensor.vignetting, "loss of light in the corners");
  binder.bind("sensor.blur_px", sensor.blur_px, "standard deviation of the lens");
  binder.bind("sensor.shutter", sensor.shutter, "share of a frame's time that it is open");
  binder.bind("sensor.noise", sensor.noise, "standard deviation at black; white = 1");
  binder.bind("sensor.shot_noise", sensor.shot_noise, "and what light adds to it at white");
}

void bindEvent(SettingsBinder& binder, ScopeEventOptions& event) {
  binder.bind("event.kind", event.kind, "none, withdraw, cover, wipe, smoke");
  binder.bind("event.start_s", event.start_s, "");
  binder.bind("event.length_s", event.length_s, "");
  binder.bind("event.return_mm", event.return_mm, "withdraw: the scope returns this far aside");
  binder.bind("event.return_deg", event.return_deg, "withdraw: and turned about its axis");
}

}  // namespace

void SimulateOptions::validate() const {
  require(frames >= 1 && frames <= 1000000, "frames", frames, "must be 1 to 1000000");
  require(truth_every >= 1, "truth_every", truth_every, "must be 1 or more");
  require(pictures == "png" || pictures == "jpg" || pictures == "mp4", "pictures", pictures,
          "must be png, jpg or mp4");
  require(jpeg_quality >= 1 && jpeg_quality <= 100, "jpeg_quality", jpeg_quality,
          "must be 1 to 100");
  require(!organ.empty(), "organ.mesh", "``", "must be builtin or a file");
  require(organ_unit_mm > 0 && organ_unit_mm <= 1e6, "organ.unit_mm", organ_unit_mm,
          "must be above 0, at most 1e6");
  simulation.validate();
  require(!input_depth || simulation.scope.lens().distortion.isZero(), "input_depth", "true",
          "needs lenses without distortion: depth files belong to rectified pictures");
}

void bindSimulateOptions(SettingsBinder& binder, SimulateOptions& options) {
  SimulationOptions& simulation = options.simulation;
  binder.bind("frames", options.frames, "how many");
  binder.bind("frames_per_second", simulation.frames_per_second, "");
  binder.bind("seed", simulation.seed, "of everything that chance decides");
  binder.bind("pictures", options.pictures, "png, jpg, or mp4: left.mp4, right.mp4");
  binder.bind("jpeg_quality", options.jpeg_quality, "1 small to 100 good");
  binder.bind("masks", options.masks, "mask/ of the instrument in the left picture");
  binder.bind("input_depth", options.input_depth, "true depth as depth/, which replaces stereo");
  binder.bind("truth_every", options.truth_every, "frames between true meshes and depths");
  binder.bind("track_spacing_px", simulation.track_spacing_px, "between tracked points");
  bindOrgan(binder, options);
  bindTexture(binder, options);
  bindDeformation(binder, simulation.deformation);
  bindCut(binder, simulation.cut);
  bindScope(binder, simulation.scope);
  bindCamera(binder, simulation.camera);
  bindInstrument(binder, simulation.instrument);
  binder.bind("smoke", simulation.smoke, "0: clear air, 1: half of the contrast");
  bindEvent(binder, simulation.event);
  bindLightAndSensor(binder, simulation.light, simulation.sensor);
}

void setPictureSize(const std::string& text, ScopeOptions& scope) {
  const auto cross = text.find('x');
  const auto width = numberOf(text.substr(0, cross));
  const auto height = cross == std::string::npos ? std::nullopt : numberOf(text.substr(cross + 1));
  const auto fits = [](double n) { return n >= 32 && n <= 8192 && n == static_cast<int>(n); };
  if (!width || !height || !fits(*width) || !fits(*height))
    throw OptionError("--size is `" + text +
                      "`, but must be WIDTHxHEIGHT, each 32 to 8192 px, e.g. 640x480");
  scope.width_px = static_cast<int>(*width);
  scope.height_px = static_cast<int>(*height);
}

TruthKinds TruthKinds::parse(const std::string& list) {
  if (list.empty()) return {};
  TruthKinds kinds{false, false, false, false, false, false};
  if (list == "none") return kinds;
  const std::vector<std::string> names{"mesh", "depth", "trajectory", "tracks", "normals", "flow"};
  bool* const fields[] = {&kinds.mesh,   &kinds.depth,   &kinds.trajectory,
                          &kinds.tracks, &kinds.normals, &kinds.flow};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const std::string nearest = nearestName(word, names);
      throw OptionError("--truth: `" + word + "` is no kind of truth" +
                        (nearest.empty() ? "" : " (did you mean `" + nearest + "`?)") +
                        ". Give some of mesh,depth,trajectory,tracks,normals,flow, or none");
    }
    *fields[found - names.begin()] = true;
  }
  return kinds;
}

}  // namespace softscope
