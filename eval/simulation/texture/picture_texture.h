// eval/simulation/texture/picture_texture.h: a photograph as texture of the tissue.
#pragma once

#include <Eigen/Geometry>

#include "core/image.h"

namespace softscope {

/// The image is projected along the scope's first viewing direction, its middle on the tissue
/// there, upright; where the surface is seen from its side, from the side instead, blended. Beyond
/// its border it goes on mirrored, so there is no seam.
class PictureTexture {
 public:
  /// `picture_mm`: its width on the tissue. `texel_mm`: no finer detail is asked for; a finer
  /// image is averaged. `body_from_view`: x right, y down, z forward, from where its middle lies.
  PictureTexture(const ColourImage& picture, double picture_mm, double texel_mm,
                 const Eigen::Isometry3d& body_from_view);

  /// Linear red, green, blue at a place of the undeformed tissue that faces along `normal`.
  Eigen::Vector3f at(const Eigen::Vector3f& rest_mm, const Eigen::Vector3f& normal) const;

  /// Of the whole image.
  const Eigen::Vector3f& mean() const { return mean_; }

 private:
  Eigen::Vector3f pixelAt(float right_mm, float down_mm) const;

  Raster<Eigen::Vector3f> linear_;
  Eigen::Vector3f mean_ = Eigen::Vector3f::Zero();
  float pixel_mm_;
  Eigen::Isometry3f view_from_body_;
};

}  // namespace softscope
