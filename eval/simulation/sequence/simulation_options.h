// eval/simulation/sequence/simulation_options.h: options of a simulated sequence.
#pragma once

#include "core/stereo_rig.h"
#include "eval/simulation/camera/camera_path.h"
#include "eval/simulation/camera/scope_event.h"
#include "eval/simulation/camera/scope_lens.h"
#include "eval/simulation/camera/sensor.h"
#include "eval/simulation/texture/tissue_texture.h"
#include "eval/simulation/tissue/organ_mesh.h"
#include "eval/simulation/tissue/tissue_deformation.h"
#include "eval/simulation/view/scope_shading.h"
#include "eval/simulation/view/scope_tool.h"
#include "eval/simulation/wound/incision.h"

namespace softscope {

/// Parallel cameras with equal lenses; rows are aligned except for calibration errors.
struct ScopeOptions {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 0;  // 0: 0.875 of the width, typical for laparoscopes
  double cx_px = -1;    // negative: image centre
  double cy_px = -1;
  double baseline_mm = 5.2;
  // OpenCV coefficients of both lenses; if any is set, the images are
  // not rectified, and per-pixel truth belongs to the raw left image.
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double row_error_px = 0;    // rows of the right image are lower by this than calibrated
  double roll_error_deg = 0;  // roll of the right camera relative to the calibration

  /// Throws OptionError.
  void validate() const;
  /// Without distortion.
  RectifiedRig rig() const;
  /// Of the left camera; the right one is equal.
  ScopeLens lens() const;
  /// Calibration as written to the file, mm.
  StereoCalibration calibration() const;
};

struct SimulationOptions {
  int seed = 1;
  double frames_per_second = 25;
  double texel_mm = 0;        // 0: three quarters of a pixel at the distance of the camera
  int track_spacing_px = 20;  // between neighbouring tracked points of the first image
  double track_border = 0.2;  // share of its width and height without tracked points
  OrganOptions organ;
  TextureOptions texture;
  DeformationOptions deformation;
  CutOptions cut;
  ScopeOptions scope;
  CameraPathOptions camera;
  LightOptions light;
  ScopeToolOptions instrument;
  double smoke = 0;  // 0: clear air, 1: half of the contrast
  ScopeEventOptions event;
  SensorOptions sensor;

  /// Throws OptionError.
  void validate() const;
};

}  // namespace softscope
