// src/pipeline/tracks/look_kernels.h: inner loops of the search of first looks, once for each
// instruction set; all give the same bytes.
#pragma once

#include <cstdint>

#include "core/kernel_list.h"
#include "pipeline/tracks/first_look.h"
#include "pipeline/tracks/shading_plane.h"

namespace softscope {

constexpr int kLookLanes = 8;
/// Pixels of a window up to whole registers; those beyond the window have no weight.
constexpr int kLookValues = (FirstLook::kPixels + kLookLanes - 1) / kLookLanes * kLookLanes;
constexpr int kBoxPx = 5;        // pixels with correlated errors are within boxes of this side
constexpr int kMapUnknowns = 6;  // of a window's place: shift, and affine map row by row

struct alignas(32) LookPlane {
  float values[kLookValues];
};

/// Places of a window's pixels in an image: (u, v) + (right, down) + map (x, y).
struct LookPlaces {
  int u, v;           // of the window's middle, rounded down
  float right, down;  // fractions
  float map[4];       // pixels of the image per pixel of the window, row by row
};

/// Rows follow each other.
struct LookImage {
  const std::uint8_t* values;
  int width_px, height_px;
};

/// One window of a first look, compared by its counted pixels.
struct LookTemplate {
  LookPlane weights;                          // 0 or 1
  double count = 0;                           // their sum
  ShadingFit shading;                         // over the counted pixels
  double contrast = 0;                        // standard deviation without shading, gray levels
  LookPlane first;                            // weighted; without shading, of standard deviation 1
  LookPlane changes[kMapUnknowns];            // of `first` per unknown; weighted, without shading
  double normal[kMapUnknowns][kMapUnknowns];  // products of the changes
  double first_changes[kMapUnknowns];         // products of `first` with them
};

/// The window of an image at some places.
struct LookSamples {
  LookPlane values;      // gray levels less `middle`
  float middle;          // near the window's middle
  ShadingPlane shading;  // of the values
  double deviation;      // standard deviation without shading
  double with_first;     // sums of products with LookTemplate::first
  double with_changes[kMapUnknowns];
};

struct LookKernels {
  const char* name;
  /// Weights and count of the pixels that are at least `room_px` inside the image and not ignored,
  /// by neither kLookValues bytes of the look (not 0 beyond the window) nor the image. `ignore` may
  /// have no values.
  void (*countPixels)(const std::uint8_t* ignored_look, const LookImage& ignore,
                      const LookPlaces& places, float room_px, LookTemplate* look);
  /// Everything but weights and count, from kLookValues gray levels.
  void (*describeLook)(const std::uint8_t* gray, LookTemplate* look);
  /// False if a counted pixel is outside of the image.
  bool (*sampleLook)(const LookTemplate& look, const LookImage& image, const LookPlaces& places,
                     LookSamples* samples);
  /// Weighted difference of the normalised windows.
  void (*differenceOf)(const LookTemplate& look, const LookSamples& samples, LookPlane* difference);
  /// Products of the changes that the slopes of `difference` would make.
  void (*normalOfNoise)(const LookTemplate& look, const LookPlane& difference,
                        double (*normal)[kMapUnknowns]);
  /// Sums of squares and product of the two place terms over all boxes of kBoxPx x kBoxPx pixels;
  /// a place term is the difference times the changes in proportion to `place`.
  void (*boxSums)(const LookTemplate& look, const LookPlane& difference,
                  const float (*place)[kMapUnknowns], double* sums);
};

/// Sets that this processor supports, slowest first.
KernelList<LookKernels> allLookKernels();
/// The fastest of them.
const LookKernels& lookKernels();

}  // namespace softscope
