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

/// The cameras: parallel, one kind of lens; rows aligned except for calibration errors.
struct ScopeOptions {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 0;  // 0: 0.875 of the width, as wide as common laparoscopes
  double cx_px = -1;    // negative: the middle of the image
  double cy_px = -1;
  double baseline_mm = 5.2;
  // OpenCV's coefficients of both lenses; any of them: the images are not rectified, and all
  // truth a pixel has lies on the left image as it is.
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  double row_error_px = 0;    // rows of the right image lie lower by this than the calibration says
  double roll_error_deg = 0;  // and it is turned by this

  /// Throws OptionError.
  void validate() const;
  /// Without distortion.
  RectifiedRig rig() const;
  /// The left camera's; the right one has the same.
  ScopeLens lens() const;
  /// What the calibration file says, mm.
  StereoCalibration calibration() const;
};

struct SimulationOptions {
  int seed = 1;
  double frames_per_second = 25;
  double texel_mm = 0;        // 0: three quarters of a pixel at the camera's distance
  int track_spacing_px = 20;  // between neighbouring tracked points of the first image
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
