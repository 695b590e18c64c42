#include "stereo/row_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "stereo/gradient_image.h"
#include "stereo/opencv_view.h"
#include "stereo/stereo_options.h"
#include "stereo/support_points.h"

namespace softscope {
namespace {

constexpr int kGridPx = 12;
constexpr int kReach = 4;                // of the window, every second pixel
constexpr int kRowReach = 2;             // rows tried around a support point's
constexpr int kCoarseOffset = 2;         // rows between the coarse trials
constexpr double kLeastCurvature = 0.3;  // of the cost over rows: less says nothing about rows

struct RowMatch {
  double u_right_px, v_right_px, difference_px;
};

/// Mean difference of the two windows.
double windowCost(const GradientView& left, const GradientView& right, int u, int v, int u_right,
                  int v_right) {
  int sum = 0;
  for (int dy = -kReach; dy <= kReach; dy += 2)
    for (int dx = -kReach; dx <= kReach; dx += 2) {
      const int a = *left.at(u + dx, v + dy), b = *right.at(u_right + dx, v_right + dy);
      sum += std::abs(a % 256 - b % 256) + std::abs(a / 256 - b / 256);
    }
  return sum / 50.0;
}

/// The row at which a support point's window matches best, to a fraction of a pixel.
std::optional<RowMatch> matchRow(const GradientView& left, const GradientView& right,
                                 const SupportPoint& point, int row_offset) {
  const int disparity = static_cast<int>(std::lround(point.disparity_px));
  std::array<double, 2 * kRowReach + 1> cost;
  cost.fill(1e9);
  for (int k = -kRowReach; k <= kRowReach; ++k)
    for (int shift = -1; shift <= 1; ++shift)
      cost[k + kRowReach] =
          std::min(cost[k + kRowReach],
                   windowCost(left, right, point.u_px, point.v_px, point.u_px - disparity + shift,
                              point.v_px + row_offset + k));
  const auto best = std::min_element(cost.begin(), cost.end());
  if (best == cost.begin() || best == cost.end() - 1) return {};
  const double curvature = best[-1] - 2 * best[0] + best[1];
  if (curvature < kLeastCurvature) return {};
  const double row = row_offset + static_cast<double>(best - cost.begin()) - kRowReach +
                     0.5 * (best[-1] - best[1]) / curvature;
  return RowMatch{static_cast<double>(point.u_px - disparity), point.v_px + row, row};
}

std::vector<RowMatch> matchRows(const GradientImage& left, const GradientImage& right,
                                int disparity_max_px, int row_offset) {
  StereoOptions options;
  options.disparity_max_px = disparity_max_px;
  options.elas.support_step_px = kGridPx;
  options.elas.support_redundant_cells = 0;
  const auto points = findSupportPoints(left, right, options, row_offset);
  const int top = kReach + kRowReach, bottom = left.height_px() - top;
  std::vector<RowMatch> matches;
  for (const SupportPoint& p : points) {
    if (p.v_px + row_offset < top || p.v_px + row_offset >= bottom) continue;
    if (const auto match = matchRow(left.view(), right.view(), p, row_offset))
      matches.push_back(*match);
  }
  return matches;
}

using Terms = Eigen::Matrix<double, 6, 1>;

Terms termsAt(const RowAlignment& scale, double u, double v) {
  const double x = (u - scale.centre_u_px) / scale.half_width_px;
  const double y = (v - scale.centre_v_px) / scale.half_width_px;
  return (Terms() << 1, x, y, x * x, x * y, y * y).finished();
}

/// Many matches in their own row: rows farther off needn't be tried.
bool isWellAligned(const std::vector<RowMatch>& matches) {
  constexpr std::size_t kMany = 150;
  if (matches.size() < kMany) return false;
  double sum = 0;
  for (const RowMatch& m : matches) sum += std::abs(m.difference_px);
  return sum < RowAlignment::kRemoveAbovePx * static_cast<double>(matches.size());
}

/// Least squares with Tukey's weights about the median, then about the model. Too few matches leave
/// `alignment` as it is.
RowAlignment fitModel(const std::vector<RowMatch>& matches, RowAlignment alignment) {
  constexpr int kRounds = 8;
  if (matches.size() < RowAlignment::kFewestMatches) return alignment;
  std::vector<double> residuals(matches.size()), sorted;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < matches.size(); ++i)
      residuals[i] =
          matches[i].difference_px - alignment.at(matches[i].u_right_px, matches[i].v_right_px);
    sorted = residuals;
    for (double& r : sorted) r = std::abs(r);
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double limit = std::max(0.4, 4.685 * 1.4826 * sorted[sorted.size() / 2]);
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Terms rhs = Terms::Zero();
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const double t = residuals[i] / limit, w = std::abs(t) < 1 ? std::pow(1 - t * t, 2) : 0;
      const Terms terms = termsAt(alignment, matches[i].u_right_px, matches[i].v_right_px);
      normal += w * terms * terms.transpose();
      rhs += w * terms * matches[i].difference_px;
    }
    // Few or clustered matches must not bend the picture: slopes cost a little, curvature more.
    normal.diagonal() += (Terms() << 0.1, 2, 2, 8, 8, 8).finished();
    const Terms solved = normal.ldlt().solve(rhs);
    std::copy_n(solved.data(), 6, alignment.model.begin());
  }
  alignment.matches = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double r = std::abs(matches[i].difference_px -
                              alignment.at(matches[i].u_right_px, matches[i].v_right_px));
    if (r > 1) continue;  // a mismatch
    ++alignment.matches;
    alignment.residual_px += r;
    alignment.mean_row_difference_px += std::abs(matches[i].difference_px);
  }
  if (alignment.matches == 0) return alignment;
  alignment.residual_px /= alignment.matches;
  alignment.mean_row_difference_px /= alignment.matches;
  return alignment;
}

}  // namespace

RowAlignment measureRowAlignment(const GrayImage& left, const GrayImage& right,
                                 int disparity_max_px) {
  const double gain = ElasOptions{}.gradient_gain;
  const GradientImage left_gradient(left, gain, disparity_max_px);
  const GradientImage right_gradient(right, gain, disparity_max_px);
  RowAlignment alignment;
  alignment.half_width_px = left.width_px / 2.0;
  alignment.centre_u_px = (left.width_px - 1) / 2.0;
  alignment.centre_v_px = (left.height_px - 1) / 2.0;
  auto matches = matchRows(left_gradient, right_gradient, disparity_max_px, 0);
  if (isWellAligned(matches)) return fitModel(matches, alignment);
  for (const int offset : {-kCoarseOffset, kCoarseOffset}) {
    const auto found = matchRows(left_gradient, right_gradient, disparity_max_px, offset);
    matches.insert(matches.end(), found.begin(), found.end());
  }
  return fitModel(matches, alignment);
}

ColourImage removeRowError(const ColourImage& right, const RowAlignment& alignment) {
  Raster<float> map_u(right.width_px, right.height_px), map_v(right.width_px, right.height_px);
  parallelRows(right.height_px, [&](int v) {
    for (int u = 0; u < right.width_px; ++u) {
      map_u.at(u, v) = static_cast<float>(u);
      map_v.at(u, v) = static_cast<float>(v + alignment.at(u, v));
    }
  });
  ColourImage aligned(right.width_px, right.height_px);
  cv::Mat view = opencvView(aligned);
  cv::remap(opencvView(right), view, opencvView(map_u), opencvView(map_v), cv::INTER_CUBIC,
            cv::BORDER_REPLICATE);
  return aligned;
}

AlignedPair alignRows(const StereoPair& rectified, int disparity_max_px) {
  AlignedPair aligned{rectified, {}, false};
  const GrayImage left = toGray(rectified.left);
  for (int round = 0; round < 2; ++round) {
    const RowAlignment found =
        measureRowAlignment(left, toGray(aligned.pair.right), disparity_max_px);
    if (round == 0) aligned.before = found;
    if (!found.known() ||
        found.mean_row_difference_px - found.residual_px < RowAlignment::kRemoveAbovePx / 2 ||
        found.mean_row_difference_px < RowAlignment::kRemoveAbovePx)
      break;
    aligned.pair.right = removeRowError(aligned.pair.right, found);
    aligned.removed = true;
  }
  return aligned;
}

}  // namespace softscope
