// toolkit/run/overlay_finder.h: structure of the image that stands still while the scope moves.
#pragma once

#include <Eigen/Geometry>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/frame.h"
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
  /// A frame whose left camera saw tissue at about `depth_mm` from that pose; pixels of its mask
  /// are no tissue anyway. The first image tells the even border. Images of another size are
  /// ignored. Works beside the caller.
  void add(std::shared_ptr<const Frame> frame, const PinholeCamera& camera,
           const Eigen::Isometry3d& world_from_left, double depth_mm);

  /// Non-zero around fixed structure; empty without images.
  Mask found() const;

 private:
  /// Part of the image with a motion of its own.
  struct Cell {
    Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
    double depth_mm = 0;
    int images = 0;
  };
  /// Of the images in which its cell had moved.
  struct Pixels {
    explicit Pixels(const ColourImage& first);
    void add(const Frame& frame, const std::vector<int>& images_of_cells);
    void ignore(const Mask& mask);

    Raster<float> mean, squares;  // grey levels; sum of squared differences from the mean
    Mask ignored;                 // in any image
  };
  bool takePose(const PinholeCamera& camera, const Eigen::Isometry3d& world_from_left,
                double depth_mm, std::vector<int>* images_of_cells);

  std::vector<Cell> cells_;
  std::shared_ptr<Pixels> pixels_;
  std::shared_future<void> pending_;  // of the last image
};

/// For a warning: share of the image, and where the mask is. Empty for an empty mask, or for so
/// little that it does no harm.
std::string overlayWarning(const Mask& found, const std::string& file);

}  // namespace softscope
