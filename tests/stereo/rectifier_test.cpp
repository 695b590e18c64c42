// tests/stereo/rectifier_test.cpp: rows correspond after rectification, and depth is right.
#include "stereo/rectification/rectifier.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "core/error.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/rectification/valid_rectification.h"
#include "support/scene.h"

namespace softscope {
namespace {

/// A rig with everything that real ones have: fx != fy, distortion, rotation between the cameras.
StereoCalibration rawRig() {
  StereoCalibration c;
  c.source = "made";
  c.left.pinhole = {320, 240, 300, 306, 162, 117};
  c.right.pinhole = {320, 240, 296, 301, 155, 124};
  c.left.distortion.coefficients = {-0.25, 0.08, 0.001, -0.0008, 0.0};
  c.right.distortion.coefficients = {-0.22, 0.06, -0.0006, 0.0009, 0.0};
  const Eigen::AngleAxisd turn(0.03, Eigen::Vector3d(0.3, 1, -0.5).normalized());
  c.right_from_left.linear() = turn.toRotationMatrix();
  c.right_from_left.translation() = Eigen::Vector3d(-5.0, 0.12, -0.08);
  return c;
}

/// Pixel at which a raw camera sees a point of its own frame; OpenCV's model is the truth.
Eigen::Vector2d seenBy(const RawCamera& camera, const Eigen::Vector3d& point_mm) {
  cv::Mat k;
  cv::eigen2cv(camera.pinhole.matrix(), k);
  std::vector<cv::Point2d> pixel;
  cv::projectPoints(std::vector<cv::Point3d>{{point_mm.x(), point_mm.y(), point_mm.z()}},
                    cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), k,
                    std::vector<double>(camera.distortion.coefficients.begin(),
                                        camera.distortion.coefficients.end()),
                    pixel);
  return {pixel[0].x, pixel[0].y};
}

/// A raw picture of a textured surface given in the raw left camera's frame.
ColourImage rawPicture(const RawCamera& camera, const Eigen::Isometry3d& camera_from_left,
                       double plane_mm) {
  const PinholeCamera& p = camera.pinhole;
  cv::Mat k;
  cv::eigen2cv(p.matrix(), k);
  std::vector<cv::Point2d> pixels, rays;
  for (int v = 0; v < p.height_px; ++v)
    for (int u = 0; u < p.width_px; ++u) pixels.emplace_back(u, v);
  cv::undistortPoints(pixels, rays, k,
                      std::vector<double>(camera.distortion.coefficients.begin(),
                                          camera.distortion.coefficients.end()),
                      cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9));
  ColourImage image(p.width_px, p.height_px);
  const Eigen::Isometry3d left_from_camera = camera_from_left.inverse();
  const Eigen::Vector3d origin = left_from_camera.translation();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d ray =
        left_from_camera.linear() * Eigen::Vector3d(rays[i].x, rays[i].y, 1);
    const Eigen::Vector3d hit = origin + (plane_mm - origin.z()) / ray.z() * ray;
    const auto gray = static_cast<std::uint8_t>(
        40 + 170 * (0.6 * test::solidTexture(hit, 1.5) + 0.4 * test::solidTexture(hit, 3.7)));
    image.values[i] = {gray, gray, gray};
  }
  return image;
}

TEST(Rectifier, MeasuresAPlaneOfTheRawFrame) {
  const StereoCalibration calibration = rawRig();
  const double plane_mm = 60;
  const StereoPair raw{rawPicture(calibration.left, Eigen::Isometry3d::Identity(), plane_mm),
                       rawPicture(calibration.right, calibration.right_from_left, plane_mm)};
  const Rectifier rectifier(calibration);
  const StereoPair pair = rectifier.rectify(raw);
  const auto matcher = makeStereoMatcher({});
  const DepthMap depth =
      depthFromDisparity(matcher->match(toGray(pair.left), toGray(pair.right)), rectifier.rig());
  std::vector<double> errors_mm;
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      const double z = depth.depth_mm.at(u, v);
      if (std::isnan(z)) continue;
      const Eigen::Vector3d rectified =
          liftPixel(rectifier.rig().left, static_cast<double>(u), static_cast<double>(v), z);
      const Eigen::Vector3d p = rectifier.rig().rectified_from_raw_left.transpose() * rectified;
      errors_mm.push_back(std::abs(p.z() - plane_mm));
    }
  ASSERT_GT(errors_mm.size(), 320u * 240u / 2);
  std::nth_element(errors_mm.begin(), errors_mm.begin() + errors_mm.size() / 2, errors_mm.end());
  // One pixel is 2.4 mm here; a twentieth of a pixel remains after two interpolations.
  EXPECT_LT(errors_mm[errors_mm.size() / 2], 0.12);
}

TEST(Rectifier, PutsAPointInTheSameRowOfBothPictures) {
  const StereoCalibration calibration = rawRig();
  const Rectifier rectifier(calibration);
  const RectifiedRig& rig = rectifier.rig();
  EXPECT_NEAR(rig.baseline_mm, calibration.right_from_left.translation().norm(), 1e-9);
  EXPECT_EQ(rig.left.fx_px, rig.left.fy_px);
  // A raw picture with one bright dot per camera: both land in one row.
  const Eigen::Vector3d point_mm(4, -6, 55);
  const auto dot = [](const Eigen::Vector2d& at) {
    ColourImage image(320, 240, Rgb8{0, 0, 0});
    for (int v = -6; v <= 6; ++v)
      for (int u = -6; u <= 6; ++u) {
        const int x = static_cast<int>(at.x()) + u, y = static_cast<int>(at.y()) + v;
        const double away = (Eigen::Vector2d(x, y) - at).squaredNorm();
        const auto gray = static_cast<std::uint8_t>(250 * std::exp(-away / 8));
        image.at(x, y) = {gray, gray, gray};
      }
    return image;
  };
  const StereoPair pair =
      rectifier.rectify({dot(seenBy(calibration.left, point_mm)),
                         dot(seenBy(calibration.right, calibration.right_from_left * point_mm))});
  const auto centroid = [](const ColourImage& image) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = 0; v < image.height_px; ++v)
      for (int u = 0; u < image.width_px; ++u) sum += image.at(u, v).red * Eigen::Vector3d(u, v, 1);
    return Eigen::Vector2d(sum.head<2>() / sum.z());
  };
  const Eigen::Vector2d left = centroid(pair.left), right = centroid(pair.right);
  EXPECT_NEAR(left.y(), right.y(), 0.05);
  const Eigen::Vector3d rectified = rig.rectified_from_raw_left * point_mm;
  EXPECT_NEAR(left.x() - right.x(), rig.disparityPx(rectified.z()), 0.05);
  EXPECT_NEAR((left - projectPoint(rig.left, rectified)).norm(), 0, 0.07);
}

TEST(Rectifier, PassesRectifiedPicturesUnchanged) {
  StereoCalibration c;
  c.rectified = true;
  c.left.pinhole = c.right.pinhole = test::endoscope(64, 48).left;
  c.right.pinhole.cx_px += 3;
  c.right_from_left.translation() = Eigen::Vector3d(-4, 0, 0);
  const Rectifier rectifier(c);
  EXPECT_EQ(rectifier.rig().baseline_mm, 4);
  EXPECT_EQ(rectifier.rig().disparity_offset_px, 3);
  EXPECT_TRUE(rectifier.outside().left.empty());
  const StereoPair pair{ColourImage(64, 48, Rgb8{1, 2, 3}), ColourImage(64, 48, Rgb8{4, 5, 6})};
  EXPECT_EQ(rectifier.rectify(pair).left.values, pair.left.values);
}

TEST(Rectifier, RefusesExchangedCamerasAndWrongSizes) {
  StereoCalibration swapped = rawRig();
  swapped.right_from_left.translation().x() *= -1;
  EXPECT_THROW(Rectifier{swapped}, InputError);
  StereoCalibration above = rawRig();
  above.right_from_left.translation() = Eigen::Vector3d(-0.1, -5, 0);
  EXPECT_THROW(Rectifier{above}, InputError);
  const Rectifier rectifier(rawRig());
  EXPECT_THROW(rectifier.rectify({ColourImage(320, 241), ColourImage(320, 241)}), InputError);
}

TEST(Rectifier, MarksWhatTheLeftCameraDidNotSee) {
  const Rectifier rectifier(rawRig());
  Mask mask(320, 240, 0);
  mask.at(160, 120) = 255;
  const Mask rectified = rectifier.rectifyMask(mask);
  EXPECT_EQ(rectified.values.size(), mask.values.size());
  EXPECT_GT(std::count(rectified.values.begin(), rectified.values.end(), 255), 0);
  EXPECT_EQ(rectifier.outside().left.values.size(), mask.values.size());
}

TEST(ValidRectification, LeavesNoPixelWithoutAnImageAndLeadsBackToTheRawOne) {
  const StereoCalibration calibration = rawRig();
  const ValidRectification valid(calibration);
  const PinholeCamera& left = valid.rig().left;
  EXPECT_GT(std::abs(left.fx_px - Rectifier(calibration).rig().left.fx_px), 1);  // another scale
  for (const auto& [u, v] : {std::pair{0, 0}, {319, 0}, {0, 239}, {319, 239}, {160, 120}}) {
    const Eigen::Vector2d raw = valid.rawLeftPixel({u, v});
    EXPECT_TRUE(raw.x() > -1 && raw.y() > -1 && raw.x() < 320 && raw.y() < 240) << raw.transpose();
  }
  // A point of the raw left camera, by OpenCV's model and by the rectified one.
  const Eigen::Vector3d point_mm(4, -3, 60);
  const Eigen::Vector2d rectified =
      projectPoint(left, Eigen::Vector3d(valid.rig().rectified_from_raw_left * point_mm));
  EXPECT_LT((valid.rawLeftPixel(rectified) - seenBy(calibration.left, point_mm)).norm(), 1e-9);
}

TEST(ValidRectification, RectifiedImagesPassUnchanged) {
  StereoCalibration calibration = rawRig();
  calibration.rectified = true;
  const ValidRectification valid(calibration);
  EXPECT_EQ(valid.rig().left.fx_px, 300);
  EXPECT_EQ(valid.rig().disparity_offset_px, 155 - 162);
  EXPECT_EQ(valid.rawLeftPixel({7, 9}), Eigen::Vector2d(7, 9));
}

}  // namespace
}  // namespace softscope
