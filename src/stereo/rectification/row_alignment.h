// src/stereo/rectification/row_alignment.h: measurement and removal of vertical disparity.
#pragma once

#include <array>
#include <cmath>

#include "core/image.h"
#include "core/row_plane.h"
#include "stereo/images/view_masks.h"

namespace softscope {

/// Result of matched pixels for the rows of a rectified pair. Row difference =
/// v_right - v_left. Its model over the right image is a polynomial, to remove not
/// only a shift and a tilt but also the effect of lens and unequal exposure times.
struct RowAlignment {
  int matches = 0;                    // pixels that agree with the model
  double mean_row_difference_px = 0;  // mean absolute difference before
  double residual_px = 0;             // mean absolute difference after removal of the model
  double agreeing_share = 0;          // of all matches: those within kAgreesPx of the model
  std::array<double, 6> model{};      // of 1, x, y, x², xy, y² in half widths from the centre
  double half_width_px = 1;           // scale of x and y
  double centre_u_px = 0, centre_v_px = 0;

  /// What the model explains of the differences; it and the noise of the matches add in squares.
  double explained_px() const {
    const double explained_px2 =
        mean_row_difference_px * mean_row_difference_px - residual_px * residual_px;
    return explained_px2 > 0 ? std::sqrt(explained_px2) : 0;
  }
  double shift_px() const { return model[0]; }
  double tilt_px_per_px() const { return model[1] / half_width_px; }
  /// The model without its curvature.
  RowPlane plane() const { return {model[0], tilt_px_per_px(), model[2] / half_width_px}; }
  double at(double u_px, double v_px) const {
    const double x = (u_px - centre_u_px) / half_width_px, y = (v_px - centre_v_px) / half_width_px;
    return model[0] + model[1] * x + model[2] * y + model[3] * x * x + model[4] * x * y +
           model[5] * y * y;
  }

  static constexpr double kAgreesPx = 0.25;      // a correct match with the model
  static constexpr double kByChance = 0.2;       // agreeing share; wrong matches have 0.1
  static constexpr int kFewestMatches = 30;      // with fewer, the result is unknown
  static constexpr double kWarnAbovePx = 0.5;    // matchers lose pixels beyond
  static constexpr double kRemoveAbovePx = 0.2;  // below, resampling costs more than it corrects
  bool known() const { return matches >= kFewestMatches; }
};

/// Matches a coarse grid of pixels over all disparities up to `disparity_max_px`
/// and up to ten rows of offset. Never fails: few matches mean !known().
RowAlignment measureRowAlignment(const GrayImage& left, const GrayImage& right,
                                 int disparity_max_px, const ViewMasks& ignored = {},
                                 const RowPlane& expected = {});

/// The right image with the row difference of the model removed.
ColourImage removeRowError(const ColourImage& right, const RowAlignment& alignment);

/// A rectified pair whose rows correspond.
struct AlignedPair {
  StereoPair pair;
  GrayImage left_gray, right_gray;  // toGray() of both
  ViewMasks ignored;                // the right one moved with its view
  RowAlignment before;              // as measured
  bool removed = false;             // whether the right image was moved
  /// Of the right camera about its optical axis, from the tilt of the rows, of which an image that
  /// was not moved has only the expected one: see removeRoll().
  double roll_rad = 0;
};

/// Measures the row difference and, where the model explains kRemoveAbovePx, measures again on the
/// moved right image, with better matches; moves the right image by the sum at once. Ignored pixels
/// do not count. Where nothing matches, rows are drawn to the expected ones.
AlignedPair alignRows(StereoPair rectified, int disparity_max_px, const ViewMasks& ignored = {},
                      const RowPlane& expected = {});
/// Measures the row difference only.
AlignedPair withoutAlignment(StereoPair rectified, int disparity_max_px, const ViewMasks& ignored,
                             const RowPlane& expected = {});

/// Moving rows removes half of a roll; the other half makes disparities
/// too large by roll_rad * (v - centre_v), px, which is subtracted here.
void removeRoll(double roll_rad, Raster<float>* disparity_px);

}  // namespace softscope
