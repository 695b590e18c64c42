// src/features/surface_patches.h: viewpoint-invariant descriptors of tissue patches.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Image with its depth, of one camera.
struct DepthImage {
  PinholeCamera camera;
  GrayImage gray;
  Mask ignore;             // empty, or non-zero for ignored pixels
  Raster<float> depth_mm;  // along the optical axis; NaN: none
};

/// Tissue patch in its tangent plane.
struct SurfacePatch {
  static constexpr int kCells = 4, kBins = 8, kSize = kCells * kCells * kBins;
  Eigen::Vector3f centre_mm;  // in the camera's frame
  std::array<std::uint8_t, kSize> descriptor;
};

/// Patches of 2 x `radius_mm` about every `spacing_px`-th pixel, by rows. Grey values are
/// sampled in the tangent plane, at a fixed size in mm and along the dominant gradient
/// direction, so they are invariant to distance, viewing angle and roll of the scope (as in
/// Wu et al., viewpoint-invariant patches, 2008); the descriptor is Lowe's histogram of
/// gradients (2004). Omitted: patches without texture, without depth, or with ignored pixels.
std::vector<SurfacePatch> surfacePatches(const DepthImage& image, double radius_mm, int spacing_px);

/// Pairs (index of a, index of b) of mutually nearest descriptors whose distance is below
/// `max_ratio` times that of the best one farther than `elsewhere_mm` from the match.
std::vector<std::pair<int, int>> matchPatches(const std::vector<SurfacePatch>& a,
                                              const std::vector<SurfacePatch>& b, double max_ratio,
                                              double elsewhere_mm);

}  // namespace softscope
