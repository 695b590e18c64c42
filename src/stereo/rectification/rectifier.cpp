#include "stereo/rectification/rectifier.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.h"
#include "core/mask_morphology.h"
#include "stereo/images/opencv_view.h"

namespace softscope {
namespace {

constexpr int kCubicReach = 2;  // px, of the resampling of colours

cv::Mat matrixOf(const RawCamera& camera) {
  cv::Mat k;
  cv::eigen2cv(camera.pinhole.matrix(), k);
  return k;
}

cv::Mat distortionOf(const RawCamera& camera) {
  return cv::Mat(1, 12, CV_64F, const_cast<double*>(camera.distortion.coefficients.data())).clone();
}

RectifiedRig rigOfRectified(const StereoCalibration& calibration) {
  RectifiedRig rig;
  rig.left = calibration.left.pinhole;
  rig.baseline_mm = -calibration.right_from_left.translation().x();
  rig.disparity_offset_px = calibration.right.pinhole.cx_px - calibration.left.pinhole.cx_px;
  return rig;
}

void requireHorizontal(const StereoCalibration& calibration) {
  const Eigen::Vector3d t = calibration.right_from_left.translation();
  // The right camera's centre in the left frame; positive x = to the right.
  const Eigen::Vector3d centre = -(calibration.right_from_left.linear().transpose() * t);
  if (centre.x() > 0 && std::abs(centre.y()) < centre.x()) return;
  std::ostringstream text;
  text << calibration.source << ": the right camera lies at (" << centre.x() << ", " << centre.y()
       << ", " << centre.z() << ") mm of the left one, but it must lie to its right (x > 0, beside "
       << "it rather than above). Are left and right exchanged, or T measured from right to left?";
  throw InputError(text.str());
}

void requireSize(const ColourImage& image, const PinholeCamera& camera, const char* side,
                 const std::string& source) {
  if (image.width_px == camera.width_px && image.height_px == camera.height_px) return;
  std::ostringstream text;
  text << source << ": the " << side << " image is " << image.width_px << " x " << image.height_px
       << " pixels, but the calibration is for " << camera.width_px << " x " << camera.height_px
       << ". Give the calibration made for this size.";
  throw InputError(text.str());
}

/// Non-zero under the mask, and outside of the raw image.
Mask resample(const Mask& raw, const cv::Mat& map_u, const cv::Mat& map_v) {
  Mask out(map_u.cols, map_u.rows);
  cv::Mat view = opencvView(out);
  cv::remap(opencvView(raw), view, map_u, map_v, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar(255));
  return out;
}

}  // namespace

struct Rectifier::Maps {
  cv::Mat left_u, left_v, right_u, right_v;
  cv::Mat left_k, left_d, left_rotation, left_projection;
};

Rectifier::~Rectifier() = default;

Rectifier::Rectifier(const StereoCalibration& calibration) {
  requireHorizontal(calibration);
  if (calibration.rectified) {
    rig_ = rigOfRectified(calibration);
    return;
  }
  const cv::Size size(calibration.left.pinhole.width_px, calibration.left.pinhole.height_px);
  const Eigen::Matrix3d rotation = calibration.right_from_left.linear();
  const Eigen::Vector3d translation = calibration.right_from_left.translation();
  cv::Mat r, t, left_rotation, right_rotation, left_projection, right_projection, q;
  cv::eigen2cv(rotation, r);
  cv::eigen2cv(translation, t);
  const cv::Mat left_k = matrixOf(calibration.left), right_k = matrixOf(calibration.right);
  const cv::Mat left_d = distortionOf(calibration.left), right_d = distortionOf(calibration.right);
  cv::stereoRectify(left_k, left_d, right_k, right_d, size, r, t, left_rotation, right_rotation,
                    left_projection, right_projection, q, cv::CALIB_ZERO_DISPARITY, -1, size);
  maps_ = std::make_unique<Maps>();
  cv::initUndistortRectifyMap(left_k, left_d, left_rotation, left_projection, size, CV_32F,
                              maps_->left_u, maps_->left_v);
  cv::initUndistortRectifyMap(right_k, right_d, right_rotation, right_projection, size, CV_32F,
                              maps_->right_u, maps_->right_v);
  maps_->left_k = left_k;
  maps_->left_d = left_d;
  maps_->left_rotation = left_rotation;
  maps_->left_projection = left_projection;
  const auto p = [&](int row, int column) { return left_projection.at<double>(row, column); };
  rig_.left = {size.width, size.height, p(0, 0), p(1, 1), p(0, 2), p(1, 2)};
  rig_.baseline_mm = -right_projection.at<double>(0, 3) / right_projection.at<double>(0, 0);
  rig_.disparity_offset_px = right_projection.at<double>(0, 2) - p(0, 2);
  cv::cv2eigen(left_rotation, rig_.rectified_from_raw_left);
  const Mask open(size.width, size.height, 0);
  outside_ = {rectifyMask(open), resample(open, maps_->right_u, maps_->right_v)};
  mixed_with_outside_ = {dilated(outside_.left, kCubicReach), dilated(outside_.right, kCubicReach)};
}

StereoPair Rectifier::rectify(const StereoPair& raw) const {
  requireSize(raw.left, rig_.left, "left", "calibration");
  requireSize(raw.right, rig_.left, "right", "calibration");
  if (!maps_) return raw;
  StereoPair out{ColourImage(raw.left.width_px, raw.left.height_px),
                 ColourImage(raw.right.width_px, raw.right.height_px)};
  cv::Mat left = opencvView(out.left), right = opencvView(out.right);
  cv::remap(opencvView(raw.left), left, maps_->left_u, maps_->left_v, cv::INTER_CUBIC);
  cv::remap(opencvView(raw.right), right, maps_->right_u, maps_->right_v, cv::INTER_CUBIC);
  return out;
}

Eigen::Vector2d Rectifier::rectifiedPixel(const Eigen::Vector2d& raw_left_px) const {
  if (!maps_) return raw_left_px;
  const std::vector<cv::Point2d> raw{{raw_left_px.x(), raw_left_px.y()}};
  std::vector<cv::Point2d> rectified;
  // The usual five steps stop at errors up to 0.02 px.
  const cv::TermCriteria enough(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-6);
  cv::undistortPoints(raw, rectified, maps_->left_k, maps_->left_d, maps_->left_rotation,
                      maps_->left_projection, enough);
  return {rectified[0].x, rectified[0].y};
}

Mask Rectifier::rectifyMask(const Mask& raw) const {
  if (!maps_) return raw;
  return resample(raw, maps_->left_u, maps_->left_v);
}

}  // namespace softscope
