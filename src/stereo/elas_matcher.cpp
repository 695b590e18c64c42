#include "stereo/elas_matcher.h"

#include "core/parallel.h"
#include "stereo/dense_matching.h"
#include "stereo/disparity_filter.h"
#include "stereo/gradient_image.h"
#include "stereo/stage_clock.h"
#include "stereo/subpixel_refinement.h"
#include "stereo/support_points.h"

namespace softscope {
namespace {

/// The same points as the right picture sees them.
std::vector<SupportPoint> seenFromRight(std::vector<SupportPoint> points) {
  for (SupportPoint& p : points) p.u_px -= static_cast<int>(p.disparity_px + 0.5f);
  return points;
}

}  // namespace

DisparityMap ElasMatcher::match(const GrayImage& left, const GrayImage& right) {
  requireRectifiedPair(left, right);
  const ElasOptions& elas = options_.elas;
  StageClock clock;
  const GradientImage left_gradient(left, elas.gradient_gain, options_.disparity_max_px);
  const GradientImage right_gradient(right, elas.gradient_gain, options_.disparity_max_px);
  clock.lap("gradients");

  const std::vector<SupportPoint> points =
      findSupportPoints(left_gradient, right_gradient, options_);
  clock.lap("support");

  Raster<std::int16_t> from_left, from_right;
  parallelInvoke(
      [&] {
        from_left = matchDense(left_gradient, right_gradient, Reference::kLeft, points, options_);
      },
      [&] {
        from_right = matchDense(left_gradient, right_gradient, Reference::kRight,
                                seenFromRight(points), options_);
      });
  clock.lap("dense");

  Raster<float> disparity_px = checkLeftRight(from_left, from_right, elas.left_right_px);
  removeDark(disparity_px, left, options_.darkest_gray, options_.dark_margin_px);
  removeSpeckles(disparity_px, elas.speckle_size_px, elas.speckle_step_px);
  fillGaps(disparity_px, elas.gap_width_px, elas.gap_step_px);
  clock.lap("filter");

  DisparityMap map = refineDisparity(left, right, disparity_px, options_.refinement);
  clock.lap("refine");

  erodeEdges(map, options_.erode_edges_px, options_.edge_step_px, options_.border_px);
  clock.lap("erode");
  times_ = clock.laps();
  return map;
}

}  // namespace softscope
