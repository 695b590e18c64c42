#include "stereo/rectification/valid_rectification.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <vector>

namespace softscope {
namespace {

struct LensMatrices {
  explicit LensMatrices(const RawCamera& camera)
      : d(1, 12, CV_64F, const_cast<double*>(camera.distortion.coefficients.data())) {
    cv::eigen2cv(camera.pinhole.matrix(), k);
  }
  cv::Mat k, d;
};

}  // namespace

ValidRectification::ValidRectification(const StereoCalibration& calibration)
    : left_(calibration.left), rectified_(calibration.rectified) {
  const PinholeCamera& camera = calibration.left.pinhole;
  if (rectified_) {
    rig_.left = camera;
    rig_.baseline_mm = -calibration.right_from_left.translation().x();
    rig_.disparity_offset_px = calibration.right.pinhole.cx_px - camera.cx_px;
    return;
  }
  const LensMatrices left(calibration.left), right(calibration.right);
  const Eigen::Matrix3d rotation = calibration.right_from_left.linear();
  const Eigen::Vector3d translation = calibration.right_from_left.translation();
  cv::Mat r, t, left_rotation, right_rotation, left_projection, right_projection, q;
  cv::eigen2cv(rotation, r);
  cv::eigen2cv(translation, t);
  cv::stereoRectify(left.k, left.d, right.k, right.d, {camera.width_px, camera.height_px}, r, t,
                    left_rotation, right_rotation, left_projection, right_projection, q,
                    cv::CALIB_ZERO_DISPARITY, /*alpha=*/0);
  const auto p = [&](int row, int column) { return left_projection.at<double>(row, column); };
  rig_.left = {camera.width_px, camera.height_px, p(0, 0), p(1, 1), p(0, 2), p(1, 2)};
  rig_.baseline_mm = -right_projection.at<double>(0, 3) / right_projection.at<double>(0, 0);
  cv::cv2eigen(left_rotation, rig_.rectified_from_raw_left);
}

Eigen::Vector2d ValidRectification::rawLeftPixel(const Eigen::Vector2d& rectified_px) const {
  if (rectified_) return rectified_px;
  const Eigen::Vector3d ray = rig_.rectified_from_raw_left.transpose() *
                              liftPixel(rig_.left, rectified_px.x(), rectified_px.y(), 1.0);
  const LensMatrices lens(left_);
  std::vector<cv::Point2d> raw;
  cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), ray.z()}}, cv::Vec3d(), cv::Vec3d(),
                    lens.k, lens.d, raw);
  return {raw[0].x, raw[0].y};
}

}  // namespace softscope
