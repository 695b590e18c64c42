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

/// An image with its depth, of one camera.
struct DepthImage {
  PinholeCamera camera;
  GrayImage gray;
  Mask ignore;             // empty, or non-zero where no tissue is to be described
  Raster<float> depth_mm;  // along the optical axis; NaN: none
};

/// A piece of tissue, as it looks in its own tangent plane.
struct SurfacePatch {
  static constexpr int kCells = 4, kBins = 8, kSize = kCells * kCells * kBins;
  Eigen::Vector3f centre_mm;  // in the camera's frame
  std::array<std::uint8_t, kSize> descriptor;
};

/// Patches of 2 x `radius_mm` about every `spacing_px`-th pixel, by rows. The grey values are
/// sampled in the tangent plane, at a fixed length in mm and along the direction that their
/// gradients prefer, so neither distance, viewing angle nor a turn of the scope changes them (as in
/// Wu et al., viewpoint-invariant patches, 2008); the descriptor is Lowe's histogram of gradients
/// (2004). Left out: patches without texture, without depth, or with ignored pixels.
std::vector<SurfacePatch> surfacePatches(const DepthImage& image, double radius_mm, int spacing_px);

/// Pairs (index of a, index of b) of mutually nearest descriptors that are nearer than `max_ratio`
/// times the best one that lies farther than `elsewhere_mm` from the match.
std::vector<std::pair<int, int>> matchPatches(const std::vector<SurfacePatch>& a,
                                              const std::vector<SurfacePatch>& b, double max_ratio,
                                              double elsewhere_mm);

}  // namespace softscope
