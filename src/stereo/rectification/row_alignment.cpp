#include "stereo/rectification/row_alignment.h"

#include <cmath>
#include <utility>

#include "stereo/rectification/row_meter.h"
#include "stereo/rectification/row_resampling.h"

namespace softscope {
namespace {

// Matches are drawn to whole rows by their noise: each measurement finds the larger part of what is
// left, and the smaller this is the better.
constexpr int kPasses = 2;

/// Whether row differences are small enough to keep the image, or unknown.
bool needsNoShift(const RowAlignment& found) {
  return !found.known() || found.explained_px() < RowAlignment::kRemoveAbovePx;
}

/// The expected one, if it counts. Before a small organ it hardly moves rows, but disparities.
double rollOf(const RowPlane& expected, int width_px) {
  return std::abs(expected.per_column) * width_px / 2 < RowAlignment::kRemoveAbovePx
             ? 0
             : expected.per_column;
}

/// After the image is moved.
RowPlane remainderOf(const RowPlane& expected, const RowAlignment& moved) {
  if (!expected.isKnown()) return expected;
  const RowPlane gone = moved.plane();
  return {expected.centre_px - gone.centre_px, expected.per_column - gone.per_column,
          expected.per_row - gone.per_row};
}

AlignedPair grayPair(StereoPair rectified, const ViewMasks& ignored) {
  AlignedPair aligned;
  aligned.left_gray = toGray(rectified.left);
  aligned.right_gray = toGray(rectified.right);
  aligned.pair = std::move(rectified);
  aligned.ignored = ignored;
  return aligned;
}

}  // namespace

RowAlignment measureRowAlignment(const GrayImage& left, const GrayImage& right,
                                 int disparity_max_px, const ViewMasks& ignored,
                                 const RowPlane& expected) {
  return RowMeter(left, disparity_max_px, ignored.left).measure(right, ignored.right, expected);
}

ColourImage removeRowError(const ColourImage& right, const RowAlignment& alignment) {
  return moveRows(right, alignment);
}

AlignedPair withoutAlignment(StereoPair rectified, int disparity_max_px, const ViewMasks& ignored,
                             const RowPlane& expected) {
  AlignedPair aligned = grayPair(std::move(rectified), ignored);
  aligned.before = measureRowAlignment(aligned.left_gray, aligned.right_gray, disparity_max_px,
                                       ignored, expected);
  return aligned;
}

AlignedPair alignRows(StereoPair rectified, int disparity_max_px, const ViewMasks& ignored,
                      const RowPlane& expected) {
  AlignedPair aligned = grayPair(std::move(rectified), ignored);
  RowMeter meter(aligned.left_gray, disparity_max_px, ignored.left);
  aligned.before = meter.measure(aligned.right_gray, ignored.right, expected);
  aligned.roll_rad = rollOf(expected, aligned.left_gray.width_px);
  if (needsNoShift(aligned.before)) return aligned;
  RowAlignment whole = aligned.before;
  for (int pass = 0; pass < kPasses; ++pass) {
    const RowAlignment rest =
        meter.measure(moveRows(aligned.right_gray, whole), moveMaskRows(ignored.right, whole),
                      remainderOf(expected, whole));
    if (!rest.known()) break;
    for (std::size_t k = 0; k < whole.model.size(); ++k) whole.model[k] += rest.model[k];
  }
  aligned.pair.right = removeRowError(aligned.pair.right, whole);
  aligned.right_gray = toGray(aligned.pair.right);
  aligned.ignored.right = moveMaskRows(ignored.right, whole);
  aligned.removed = true;
  aligned.roll_rad = whole.tilt_px_per_px();
  return aligned;
}

void removeRoll(double roll_rad, Raster<float>* disparity_px) {
  const double centre_v_px = (disparity_px->height_px - 1) / 2.0;
  for (int v = 0; v < disparity_px->height_px; ++v) {
    const float excess_px = static_cast<float>(roll_rad * (v - centre_v_px));
    for (int u = 0; u < disparity_px->width_px; ++u) disparity_px->at(u, v) -= excess_px;
  }
}

}  // namespace softscope
