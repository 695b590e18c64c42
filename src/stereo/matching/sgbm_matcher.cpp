#include "stereo/matching/sgbm_matcher.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "core/mask_morphology.h"
#include "core/not_measured.h"
#include "stereo/images/opencv_view.h"
#include "stereo/kernels/matching_kernels.h"
#include "stereo/matching/stage_clock.h"
#include "stereo/refinement/disparity_filter.h"

namespace softscope {
namespace {

constexpr float kStandardErrorPx = 0.3f;  // measured on textured tissue: docs/stereo.md §7

/// The image with `columns` copies of its first column on the left: OpenCV matches only pixels for
/// which the whole range of disparities lies inside of the right image.
cv::Mat widenedLeft(const GrayImage& image, int columns) {
  cv::Mat wide;
  cv::copyMakeBorder(opencvView(image), wide, 0, 0, columns, 0, cv::BORDER_REPLICATE);
  return wide;
}

}  // namespace

DisparityMap SgbmMatcher::match(const GrayImage& left_image, const GrayImage& right_image,
                                const ViewMasks& ignored) {
  requireRectifiedPair(left_image, right_image);
  const auto [left, right, masks] = matchableViews(left_image, right_image, ignored);
  StageClock clock;
  const int max_px = options_.forWidth(left_image.width_px).disparity_max_px;
  const int count = (max_px - options_.disparity_min_px + 16) / 16 * 16;
  const int block = options_.sgbm_block_px, area = block * block;
  const auto sgbm = cv::StereoSGBM::create(options_.disparity_min_px, count, block, 8 * area,
                                           32 * area, 1, 63, 10, 100, 2);
  const int columns = std::max(0, options_.disparity_min_px + count);
  cv::Mat found;
  sgbm->compute(widenedLeft(left, columns), widenedLeft(right, columns), found);  // 1/16 px
  clock.lap("match");
  DisparityMap map{Raster<float>(left.width_px, left.height_px, kNotMeasured<float>),
                   Raster<float>(left.width_px, left.height_px, kNotMeasured<float>)};
  const Mask left_blocked = dilated(masks.left, options_.sgbm_block_px / 2 + kSobelReach);
  const Mask right_blocked = dilated(masks.right, options_.sgbm_block_px / 2 + kSobelReach);
  const auto is_blocked = [](const Mask& blocked, int u, int v) {
    return blocked.contains(u, v) && blocked.at(u, v) != 0;
  };
  const short unmatched = static_cast<short>((options_.disparity_min_px - 1) * 16);
  for (int v = 0; v < left.height_px; ++v)
    for (int u = 0; u < left.width_px; ++u) {
      const short d = found.at<short>(v, columns + u);
      if (d <= unmatched || d > 16 * u) continue;
      if (is_blocked(left_blocked, u, v) || is_blocked(right_blocked, u - (d + 8) / 16, v))
        continue;
      map.disparity_px.at(u, v) = static_cast<float>(d) / 16;
      map.sigma_px.at(u, v) = kStandardErrorPx;
    }
  removeDark(map.disparity_px, left, options_.darkest_gray, options_.dark_margin_px);
  erodeEdges(map, options_.erode_edges_px, options_.edge_step_px, options_.border_px);
  clock.lap("erode");
  times_ = clock.laps();
  return map;
}

}  // namespace softscope
