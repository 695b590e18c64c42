// toolkit/face/depth.cpp: implementation of include/softscope/depth.h.
#include "softscope/depth.h"

#include "pipeline/backends.h"
#include "toolkit/depth/depth_estimator.h"
#include "toolkit/depth/frame_statistics.h"
#include "toolkit/face/calibration_data.h"
#include "toolkit/face/image_copies.h"
#include "toolkit/face/model_copy.h"
#include "toolkit/face/run_options_of.h"

namespace softscope::api {

namespace {

softscope::DepthEstimator made(Chosen<std::unique_ptr<FrameDepth>> chosen) {
  return softscope::DepthEstimator(std::move(chosen.part), chosen.name, /*raw_left=*/false);
}

}  // namespace

struct DepthEstimator::Impl {
  Impl(const Calibration& given, const FrameDepthOptions& options, const std::string& backend)
      : calibration(sized(given.data().calibration)),
        estimator(made(makeFrameDepth(backend, calibration, options))) {}

  StereoCalibration calibration;
  softscope::DepthEstimator estimator;
};

DepthEstimator::DepthEstimator(const Calibration& calibration, const Options& options,
                               const std::string& backend)
    : impl_(std::make_unique<Impl>(calibration, depthOptionsOf(options).measurement, backend)) {}
DepthEstimator::~DepthEstimator() = default;
DepthEstimator::DepthEstimator(DepthEstimator&&) noexcept = default;
DepthEstimator& DepthEstimator::operator=(DepthEstimator&&) noexcept = default;

Depth DepthEstimator::measure(const FrameView& frame) {
  const DepthResult measured = impl_->estimator.measure(frameOf(frame, impl_->calibration, 0));
  const RectifiedRig& rig = impl_->estimator.rig();
  Depth depth;
  depth.width_px = measured.depth.depth_mm.width_px;
  depth.height_px = measured.depth.depth_mm.height_px;
  depth.depth_mm = measured.depth.depth_mm.values;
  depth.sigma_mm = measured.depth.sigma_mm.values;
  depth.normals = floatsOf(measured.normals.values);
  depth.left = imageOf(measured.left);
  depth.focal_px = rig.left.fx_px;
  depth.centre_u_px = rig.left.cx_px;
  depth.centre_v_px = rig.left.cy_px;
  depth.baseline_mm = rig.baseline_mm;
  depth.coverage = coverageOf(measured).share;
  depth.method = measured.method;
  return depth;
}

}  // namespace softscope::api
