#include "stereo/matching/elas_matcher.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "stereo/images/gradient_image.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/dense_matching.h"
#include "stereo/matching/stage_clock.h"
#include "stereo/matching/support_points.h"
#include "stereo/refinement/disparity_filter.h"
#include "stereo/refinement/fringes.h"
#include "stereo/refinement/patch_smoothing.h"
#include "stereo/refinement/pyramid.h"
#include "stereo/refinement/rims.h"
#include "stereo/refinement/subpixel_refinement.h"

namespace softscope {
namespace {

constexpr double kEverything = 2;  // larger than any share

/// One level of the pyramid, with times to `clock`. Ignored pixels are filled.
DisparityMap matchLevel(const GrayImage& left, const GrayImage& right, const ViewMasks& ignored,
                        const StereoOptions& options, StageClock& clock) {
  const ElasOptions& elas = options.elas;
  const GradientImage left_gradient(left, elas.gradient_gain, options.disparity_max_px,
                                    ignored.left);
  const GradientImage right_gradient(right, elas.gradient_gain, options.disparity_max_px,
                                     ignored.right);
  clock.lap("gradients");

  const std::vector<SupportPoint> points =
      findSupportPoints(left_gradient, right_gradient, options);
  clock.lap("support");

  Raster<std::int16_t> from_left, from_right;
  parallelInvoke(
      [&] {
        from_left = matchDense(left_gradient, right_gradient, Reference::kLeft, points, options);
      },
      [&] {
        from_right = matchDense(left_gradient, right_gradient, Reference::kRight,
                                supportFromRight(points), options);
      });
  clock.lap("dense");

  Raster<float> disparity_px = checkLeftRight(from_left, from_right, elas.left_right_px);
  removeDark(disparity_px, left, options.darkest_gray, options.dark_margin_px);
  removeSpeckles(disparity_px, elas.speckle_size_px, elas.speckle_step_px);
  fillGaps(disparity_px, elas.gap_width_px, elas.gap_step_px);
  dropMasked(ignored.left, &disparity_px);
  clock.lap("filter");

  DisparityMap map = refineDisparity(left, right, disparity_px, options.refinement);
  clock.lap("refine");
  return map;
}

/// Unmatched share of the pixels that are bright enough and
/// right of the strip that is invisible to the right camera.
double unmatchedShare(const DisparityMap& map, const GrayImage& left, const Mask& ignored,
                      int darkest_gray) {
  float nearest_px = 0;
  for (const float d : map.disparity_px.values) nearest_px = d > nearest_px ? d : nearest_px;
  std::size_t matchable = 0, unmatched = 0;
  for (int v = 0; v < left.height_px; ++v)
    for (int u = static_cast<int>(nearest_px); u < left.width_px; ++u) {
      if (left.at(u, v) < darkest_gray || (!ignored.empty() && ignored.at(u, v) != 0)) continue;
      ++matchable;
      unmatched += std::isnan(map.disparity_px.at(u, v));
    }
  return matchable == 0 ? 1 : static_cast<double>(unmatched) / static_cast<double>(matchable);
}

/// `finer_unmatched`: unmatched share at twice the size; above 1 at full size.
DisparityMap matchPyramid(const GrayImage& left, const GrayImage& right, const ViewMasks& ignored,
                          const StereoOptions& options, int coarser_levels, double finer_unmatched,
                          StageClock& clock) {
  DisparityMap map = matchLevel(left, right, ignored, options, clock);
  if (coarser_levels == 0 || std::min(left.width_px, left.height_px) < 2 * kSmallestPicturePx)
    return map;
  const double unmatched = unmatchedShare(map, left, ignored.left, options.darkest_gray);
  if (!isHalvingWorth(options.elas, unmatched, finer_unmatched)) return map;
  fillFromHalf(
      matchPyramid(halve(left), halve(right), {halvedMask(ignored.left), halvedMask(ignored.right)},
                   halved(options), coarser_levels - 1, unmatched, clock),
      map);
  clock.lap("fill");
  return map;
}

}  // namespace

DisparityMap ElasMatcher::match(const GrayImage& left_image, const GrayImage& right_image,
                                const ViewMasks& ignored) {
  requireRectifiedPair(left_image, right_image);
  StageClock clock;
  const MatchableViews views = matchableViews(left_image, right_image, ignored);
  DisparityMap map =
      matchPyramid(views.left, views.right, ignored, options_.forWidth(left_image.width_px),
                   options_.elas.coarser_levels, kEverything, clock);
  dropMasked(ignored.left, &map.disparity_px);
  removeDark(map.disparity_px, views.left, options_.darkest_gray, options_.dark_margin_px);
  clock.lap("dark");
  smoothByPatches(options_.smoothing, options_.refinement, map);
  clock.lap("smooth");
  doubtRims(&map);
  doubtFringes(views.left, &map);
  erodeEdges(map, options_.erode_edges_px, options_.edge_step_px, options_.border_px);
  clock.lap("erode");
  times_ = clock.laps();
  return map;
}

}  // namespace softscope
