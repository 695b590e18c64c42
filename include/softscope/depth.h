// include/softscope/depth.h: depth of a stereo pair.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "softscope/calibration.h"
#include "softscope/frame.h"
#include "softscope/options.h"

namespace softscope::api {

/// Rasters of the rectified left camera, height x
/// width, row-major; NaN for unmeasured pixels.
struct Depth {
  int width_px = 0, height_px = 0;
  std::vector<float> depth_mm;  // along the optical axis
  std::vector<float> sigma_mm;  // predicted standard error; NaN if unknown
  std::vector<float> normals;   // height x width x 3, unit length, towards the camera
  Image left;                   // rectified left image
  double focal_px = 0, centre_u_px = 0, centre_v_px = 0, baseline_mm = 0;  // of the rectified pair
  double coverage = 0;  // measured share of the unmasked pixels
  std::string method;   // elas or sgbm
};

/// For one thread at a time; parallel inside.
class DepthEstimator {
 public:
  /// `options`: keys stereo.* and depth.*; `backend`: cpu, cuda or auto
  /// (GPU if available). Throws OptionError, InputError and BackendError.
  explicit DepthEstimator(const Calibration& calibration, const Options& options = {},
                          const std::string& backend = "cpu");
  ~DepthEstimator();
  DepthEstimator(DepthEstimator&&) noexcept;
  DepthEstimator& operator=(DepthEstimator&&) noexcept;

  /// Throws InputError for an image that does not fit the calibration.
  Depth measure(const FrameView& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope::api
