// src/stereo/rectification/row_meter.h: matches between left and right images, with vertical
// disparity.
#pragma once

#include <vector>

#include "core/image.h"
#include "stereo/images/gradient_image.h"
#include "stereo/options/stereo_options.h"
#include "stereo/rectification/row_alignment.h"
#include "stereo/rectification/row_model.h"

namespace softscope {

/// Measures right images against one left image, on a coarse grid, over all disparities up to
/// `disparity_max_px` and rows up to ten off. No support point lies within a window of an ignored
/// pixel.
class RowMeter {
 public:
  RowMeter(const GrayImage& left, int disparity_max_px, const Mask& ignored = {});

  /// What was found; most of it right.
  std::vector<RowMatch> match(const GrayImage& right, const Mask& ignored = {});

  /// The smooth row difference through it.
  RowAlignment measure(const GrayImage& right, const Mask& ignored = {}) {
    return fitRowModel(match(right, ignored), scale());
  }

  /// Nothing known yet: the frame of reference of fitRowModel().
  RowAlignment scale() const;

 private:
  std::vector<RowMatch> matchRows(const GradientImage& right, int row_offset);

  int margin_px_;
  GradientImage left_;
  StereoOptions options_;
};

}  // namespace softscope
