// src/stereo/options/stereo_settings.h: keys, ranges and meanings of the stereo stage's settings.
#pragma once

#include "core/setting_rules.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, ElasOptions& o) {
  v("stereo.elas.coarser_levels", o.coarser_levels, atLeast(0),
    "half sizes tried where texture is weak");
}

template <class Visitor>
void describe(Visitor& v, SmoothingOptions& o) {
  v("stereo.smoothing.reach_blocks", o.reach_blocks, between(0, 7),
    "of a window, to each side; 0: no smoothing");
}

template <class Visitor>
void describe(Visitor& v, StereoOptions& o) {
  v("stereo.method", o.method, oneOf(stereoMethods()), "how disparity is found: docs/stereo.md");
  v("stereo.model", o.model, FreeText{"empty or a file"}, "the network of onnx, an ONNX file");
  v("stereo.model_input", o.model_input, oneOf({"levels", "unit", "imagenet"}),
    "the network takes 0 to 255, 0 to 1, or ImageNet's mean 0 and deviation 1");
  v("stereo.disparity_min_px", o.disparity_min_px, atLeast(0), "smallest disparity sought");
  v("stereo.disparity_max_px", o.disparity_max_px, between(0, StereoOptions::kLargestDisparityPx),
    "largest disparity sought; above disparity_min_px; 0: 255 or two fifths of the width");
  describe(v, o.elas);
  describe(v, o.smoothing);
}

}  // namespace softscope
