// toolkit/depth/depth_estimator.cpp: measured depth with its point cloud in the selected frame.
#include "toolkit/depth/depth_estimator.h"

#include "stereo/depth/depth_from_disparity.h"
#include "stereo/depth/relief_error.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {
namespace {

void turn(PointCloud& cloud, const Eigen::Matrix3f& rotation) {
  for (Eigen::Vector3f& point : cloud.points_mm) point = rotation * point;
  for (Eigen::Vector3f& normal : cloud.normals) normal = rotation * normal;
}

}  // namespace

DepthResult DepthEstimator::measure(const Frame& frame) {
  DepthResult result{depth_->measure(frame), {}};
  StageClock clock;
  addReliefError(rig(), &result.disparity, &result.depth);
  clock.lap("relief");
  result.cloud =
      pointCloud(result.depth.depth_mm, result.normals, result.left, rig().left, result.mask);
  if (raw_left_) turn(result.cloud, rig().rectified_from_raw_left.transpose().cast<float>());
  clock.lap("cloud");
  result.times.insert(result.times.end(), clock.laps().begin(), clock.laps().end());
  return result;
}

}  // namespace softscope
