// src/features/dense_surf.h: SURF descriptors on a regular grid of pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Upright, at one scale. Scale s of SURF corresponds to wavelets of 2 s and cells of 5 s pixels.
struct DenseSurfOptions {
  static constexpr int kGridPx = 3;     // from one descriptor to the next
  static constexpr int kWaveletPx = 4;  // side of the Haar wavelets; even
  int cell_px = 6;                      // side of the 4 x 4 cells; a multiple of grid_px
  // of wavelets with ignored pixels in a descriptor
  static constexpr double kMaxInvalidShare = 0.4;
  // minimum mean difference of the halves of the wavelets
  static constexpr double kMinContrastGray = 0.8;
};

/// Descriptors on a grid: node (i, j) describes the square of 4 cells
/// around pixel (first_px + i * grid_px, first_px + j * grid_px).
struct DenseDescriptors {
  int first_px = 0;
  int grid_px = 3;
  Raster<std::uint8_t> valid;       // columns x rows of nodes, 1 = may be matched
  Raster<float> contrast_gray;      // same shape
  std::vector<std::uint8_t> bytes;  // 64 a node, see kDescriptorUnit

  int columns() const { return valid.width_px; }
  int rows() const { return valid.height_px; }
  const std::uint8_t* descriptor(int column, int row) const {
    return bytes.data() + 64 * (static_cast<std::size_t>(row) * columns() + column);
  }
};

/// Sums of dx, |dx|, dy and |dy| in 4 x 4 cells (Bay et al. 2008), length 1, on a dense
/// grid (Uijlings, Smeulders, Scha 2009): wavelets are computed from an integral image,
/// each is summed once into its grid square, each square once into its cells, and a cell
/// is shared by 16 descriptors. Without the Gaussian weights of SURF, which would prevent
/// the sharing. `ignore` is empty or has the size of the image, non-zero = invalid. An
/// image smaller than one descriptor gives none. Throws Error for different sizes.
DenseDescriptors denseSurf(const GrayImage& image, const Mask& ignore,
                           const DenseSurfOptions& options);

}  // namespace softscope
