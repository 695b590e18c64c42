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

/// Measures right images against one left image, on a coarse grid,
/// over all disparities up to `disparity_max_px` and up to ten rows of
/// offset. No support point is within a window of an ignored pixel.
class RowMeter {
 public:
  RowMeter(const GrayImage& left, int disparity_max_px, const Mask& ignored = {});

  /// Matches; most of them correct. With `expected` rows, those of the right image moved by them.
  std::vector<RowMatch> match(const GrayImage& right, const Mask& ignored = {},
                              const RowPlane& expected = {});

  /// The smooth row difference of the matches, of which rows that correspond need only half; where
  /// nothing matches, the expected one. Known rows are not searched for.
  RowAlignment measure(const GrayImage& right, const Mask& ignored = {},
                       const RowPlane& expected = {});

  /// Without measurement: the frame of reference of fitRowModel().
  RowAlignment scale() const;

 private:
  bool isSteep(const RowPlane& expected) const;
  GradientImage gradientOf(const GrayImage& right, const Mask& ignored) const;
  std::vector<RowMatch> matchNearest(const GradientImage& right, const RowPlane& expected = {});
  std::vector<RowMatch> matchRows(const GradientImage& right, int row_offset, int grid_px);

  int margin_px_;
  int grid_px_;
  GradientImage left_;
  StereoOptions options_;
};

}  // namespace softscope
