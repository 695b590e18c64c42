// toolkit/run/overlay_finder.h: structure of the image that stands still while the scope moves.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/image.h"

namespace softscope {

/// In a run folder, the mask of what was found.
inline constexpr const char* kOverlayFile = "overlay_mask.png";

/// Text and icons of the recorder, dirt on the lens: fixed in the image, so they are measured as a
/// surface at a wrong distance. Tissue cannot be told from them where the scope is at rest.
///
/// Mean and variance of each pixel's grey level over images between which the tissue around it has
/// moved in the image. An edge that moves has a variance of at least the square of the gradient of
/// the mean, as it passes over the pixel; a fixed one has that of noise alone.
class OverlayFinder {
 public:
  /// An image whose left camera saw tissue at about `depth_mm` from that pose. `mask`: pixels that
  /// are no tissue anyway; may be empty. The first image tells the even border. Images of another
  /// size are ignored.
  void add(const ColourImage& left, const Mask& mask, const PinholeCamera& camera,
           const Eigen::Isometry3d& world_from_left, double depth_mm);

  /// Non-zero around fixed structure; empty while too few images have moved.
  Mask found() const;

 private:
  /// Part of the image with a motion of its own.
  struct Cell {
    Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
    double depth_mm = 0;
    int images = 0;
  };
  std::vector<char> cellsThatMoved(const PinholeCamera& camera,
                                   const Eigen::Isometry3d& world_from_left, double depth_mm);

  void ignore(const Mask& mask);

  int columns_ = 0;
  std::vector<Cell> cells_;
  Raster<float> mean_, squares_;  // grey levels; sum of squared differences from the mean
  Mask ignored_;                  // in any image
};

/// For a warning: share of the image, and where the mask is. Empty for an empty mask, or for so
/// little that it does no harm.
std::string overlayWarning(const Mask& found, const std::string& file);

}  // namespace softscope
