// include/softscope/depth.h: one stereo pair to depth.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "softscope/calibration.h"
#include "softscope/frame.h"
#include "softscope/options.h"

namespace softscope::api {

/// Rasters of the rectified left camera, height x width, rows first; NaN where nothing was
/// measured.
struct Depth {
  int width_px = 0, height_px = 0;
  std::vector<float> depth_mm;  // along the optical axis
  std::vector<float> sigma_mm;  // predicted standard error; NaN where unknown
  std::vector<float> normals;   // height x width x 3, unit length, towards the camera
  Image left;                   // the rectified left image
  double focal_px = 0, centre_u_px = 0, centre_v_px = 0, baseline_mm = 0;  // of the rectified pair
  double coverage = 0;  // share of the pixels that no mask hides
  std::string method;   // elas or sgbm
};

/// For one thread at a time; works on many.
class DepthEstimator {
 public:
  /// `options`: keys stereo.* and depth.*; `backend`: cpu, cuda or auto, which starts a GPU if
  /// there is one. Throws OptionError, InputError and BackendError.
  explicit DepthEstimator(const Calibration& calibration, const Options& options = {},
                          const std::string& backend = "cpu");
  ~DepthEstimator();
  DepthEstimator(DepthEstimator&&) noexcept;
  DepthEstimator& operator=(DepthEstimator&&) noexcept;

  /// Throws InputError where an image does not fit the calibration.
  Depth measure(const FrameView& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope::api
