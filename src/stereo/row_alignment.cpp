#include "stereo/row_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "stereo/opencv_view.h"

namespace softscope {
namespace {

constexpr int kCorners = 400;
constexpr int kHalfWindow = 7;
constexpr int kRowReach = 6;
constexpr double kLeastCorrelation = 0.9;

struct RowMatch {
  double u_px, difference_px;
};

/// Peak of the parabola through three values, within half a step.
double parabolaPeak(double before, double at, double after) {
  const double curvature = before - 2 * at + after;
  return curvature < 0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0;
}

/// Where the window around a left corner lies in the right picture.
std::optional<RowMatch> matchCorner(const cv::Mat& left, const cv::Mat& right,
                                    const cv::Point& corner, int disparity_max_px) {
  const cv::Rect window(corner.x - kHalfWindow, corner.y - kHalfWindow, 2 * kHalfWindow + 1,
                        2 * kHalfWindow + 1);
  const int first = std::max(0, window.x - disparity_max_px);
  const cv::Rect search = cv::Rect(first, window.y - kRowReach, window.x + window.width - first,
                                   window.height + 2 * kRowReach) &
                          cv::Rect(0, 0, right.cols, right.rows);
  if (search.height != window.height + 2 * kRowReach || search.width <= window.width) return {};
  cv::Mat score;
  cv::matchTemplate(right(search), left(window), score, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
  if (best < kLeastCorrelation || at.y == 0 || at.y == score.rows - 1) return {};
  const double sub =
      parabolaPeak(score.at<float>(at.y - 1, at.x), best, score.at<float>(at.y + 1, at.x));
  return RowMatch{static_cast<double>(corner.x), at.y - kRowReach + sub};
}

std::vector<RowMatch> matchCorners(const GrayImage& left, const GrayImage& right,
                                   int disparity_max_px) {
  const cv::Mat left_view = opencvView(left), right_view = opencvView(right);
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left_view, corners, kCorners, 0.01, 8);
  std::vector<std::optional<RowMatch>> found(corners.size());
  parallelRanges(static_cast<int>(corners.size()), 4, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const cv::Point corner(static_cast<int>(corners[i].x), static_cast<int>(corners[i].y));
      const cv::Rect inside(kHalfWindow, kHalfWindow, left_view.cols - 2 * kHalfWindow,
                            left_view.rows - 2 * kHalfWindow);
      if (inside.contains(corner))
        found[i] = matchCorner(left_view, right_view, corner, disparity_max_px);
    }
  });
  std::vector<RowMatch> matches;
  for (const auto& match : found)
    if (match) matches.push_back(*match);
  return matches;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Wrong matches scatter over all rows; right ones lie together.
std::vector<RowMatch> keepConsistent(const std::vector<RowMatch>& matches) {
  if (matches.empty()) return matches;
  std::vector<double> differences, spread;
  for (const RowMatch& m : matches) differences.push_back(m.difference_px);
  const double centre = median(differences);
  for (const double d : differences) spread.push_back(std::abs(d - centre));
  const double limit = std::max(1.0, 4 * 1.4826 * median(spread));
  std::vector<RowMatch> kept;
  for (const RowMatch& m : matches)
    if (std::abs(m.difference_px - centre) <= limit) kept.push_back(m);
  return kept;
}

}  // namespace

RowAlignment measureRowAlignment(const GrayImage& left, const GrayImage& right,
                                 int disparity_max_px) {
  const std::vector<RowMatch> matches = keepConsistent(matchCorners(left, right, disparity_max_px));
  RowAlignment alignment;
  alignment.matches = static_cast<int>(matches.size());
  if (!alignment.known()) return alignment;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
  for (const RowMatch& m : matches) {
    const Eigen::Vector2d row(1, m.u_px - left.width_px / 2.0);
    normal += row * row.transpose();
    rhs += row * m.difference_px;
    alignment.mean_row_difference_px += std::abs(m.difference_px) / alignment.matches;
  }
  const Eigen::Vector2d model = normal.ldlt().solve(rhs);
  alignment.shift_px = model.x();
  alignment.tilt_px_per_px = model.y();
  for (const RowMatch& m : matches)
    alignment.residual_px +=
        std::abs(m.difference_px - model.x() - model.y() * (m.u_px - left.width_px / 2.0)) /
        alignment.matches;
  return alignment;
}

ColourImage removeRowError(const ColourImage& right, const RowAlignment& alignment) {
  const cv::Mat affine = (cv::Mat_<double>(2, 3) << 1, 0, 0, alignment.tilt_px_per_px, 1,
                          alignment.shift_px - alignment.tilt_px_per_px * right.width_px / 2.0);
  ColourImage aligned(right.width_px, right.height_px);
  cv::Mat view = opencvView(aligned);
  cv::warpAffine(opencvView(right), view, affine, view.size(),
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return aligned;
}

}  // namespace softscope
