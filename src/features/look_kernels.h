// src/features/look_kernels.h: inner loops of the search of first looks, once for each
// instruction set; all give the same bytes.
#pragma once

#include <cstdint>

#include "core/kernel_list.h"
#include "features/look_formulas.h"

namespace softscope {

struct alignas(32) LookPlane {
  float values[kLookValues];
};

/// Rows follow each other.
struct LookImage {
  const std::uint8_t* values;
  int width_px, height_px;
};

/// A window with its planes.
struct LookTemplate : LookFacts {
  LookPlane weights;                // 0 or 1
  LookPlane first;                  // weighted; without shading, of standard deviation 1
  LookPlane changes[kMapUnknowns];  // of `first` per unknown; weighted, without shading
};

struct LookSamples : LookSighting {
  LookPlane values;  // gray levels less `middle`
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
  /// Sums of the squares of both place terms over all boxes of kBoxPx x kBoxPx pixels; a place term
  /// is the difference times the changes in proportion to `place`.
  void (*boxSums)(const LookTemplate& look, const LookPlane& difference,
                  const float (*place)[kMapUnknowns], double* sums);
};

/// Sets that this processor supports, slowest first.
KernelList<LookKernels> allLookKernels();
/// The fastest of them.
const LookKernels& lookKernels();

}  // namespace softscope
