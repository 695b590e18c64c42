// eval/simulation/texture/picture_texture.h: image as texture of the tissue.
#pragma once

#include <Eigen/Geometry>

#include "core/image.h"

namespace softscope {

/// The image is projected along the first viewing direction of the scope, upright,
/// with its centre on the target; inclined surfaces use lateral projections,
/// blended. Beyond its border the image is mirrored, so there is no seam.
class PictureTexture {
 public:
  /// `picture_mm`: width on the tissue. `texel_mm`: resolution; a finer image is averaged.
  /// `body_from_view`: x right, y down, z forward, with the origin at the image centre.
  PictureTexture(const ColourImage& picture, double picture_mm, double texel_mm,
                 const Eigen::Isometry3d& body_from_view);

  /// Linear red, green, blue at a position of the undeformed tissue with this normal.
  Eigen::Vector3f at(const Eigen::Vector3f& rest_mm, const Eigen::Vector3f& normal) const;

  /// Mean of the whole image.
  const Eigen::Vector3f& mean() const { return mean_; }

 private:
  Eigen::Vector3f pixelAt(float right_mm, float down_mm) const;

  Raster<Eigen::Vector3f> linear_;
  Eigen::Vector3f mean_ = Eigen::Vector3f::Zero();
  float pixel_mm_;
  Eigen::Isometry3f view_from_body_;
};

}  // namespace softscope
