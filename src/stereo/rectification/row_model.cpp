#include "stereo/rectification/row_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/median.h"

namespace softscope {
namespace {

constexpr int kRounds = 8, kFirstLimit = 4;
constexpr double kMismatchPx = 1;       // from the model: the match no longer counts
constexpr double kLeastLimitPx = 0.4;   // of the residuals that count
constexpr int kColumns = 8, kRows = 6;  // of the grid in which matches are counted
constexpr double kEmptyWeight = 1;      // of the common difference, in a cell without matches

using Terms = Eigen::Matrix<double, 6, 1>;

Terms termsAt(const RowAlignment& scale, double u, double v) {
  const double x = (u - scale.centre_u_px) / scale.half_width_px;
  const double y = (v - scale.centre_v_px) / scale.half_width_px;
  return (Terms() << 1, x, y, x * x, x * y, y * y).finished();
}

struct RowEquations {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Terms rhs = Terms::Zero();

  void add(const Terms& terms, double difference_px, double weight) {
    normal += weight * terms * terms.transpose();
    rhs += weight * difference_px * terms;
  }
};

/// Number of matches per cell of a grid.
class CellCounts {
 public:
  explicit CellCounts(const RowAlignment& scale)
      : width_px_(2 * scale.centre_u_px + 1), height_px_(2 * scale.centre_v_px + 1) {}

  void add(const RowMatch& match, double weight) {
    const int c =
        std::clamp(static_cast<int>(match.u_right_px * kColumns / width_px_), 0, kColumns - 1);
    const int r = std::clamp(static_cast<int>(match.v_right_px * kRows / height_px_), 0, kRows - 1);
    weight_[r][c] += weight;
  }

  /// Without matches rows differ by the common difference, instead of an extrapolated curvature.
  void addEmptyCells(const RowAlignment& scale, double common_px, RowEquations& equations) const {
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c)
        if (weight_[r][c] < 1)
          equations.add(
              termsAt(scale, (c + 0.5) * width_px_ / kColumns, (r + 0.5) * height_px_ / kRows),
              common_px, kEmptyWeight);
  }

 private:
  double width_px_, height_px_;
  double weight_[kRows][kColumns] = {};
};

std::vector<double> residualsOf(const std::vector<RowMatch>& matches,
                                const RowAlignment& alignment) {
  std::vector<double> residuals;
  for (const RowMatch& m : matches)
    residuals.push_back(m.difference_px - alignment.at(m.u_right_px, m.v_right_px));
  return residuals;
}

void subtract(const RowAlignment& plane, std::vector<RowMatch>* matches) {
  for (RowMatch& m : *matches) m.difference_px -= plane.at(m.u_right_px, m.v_right_px);
}

/// Standard deviation of most of them about zero: by their median size.
double scatterOf(std::vector<double> values) {
  for (double& x : values) x = std::abs(x);
  return 1.4826 * medianOf(std::move(values));
}

/// The median difference, as far as it exceeds the scatter: all rows of a calibration differ alike,
/// those of an organ that moves between the exposures do not.
double commonDifference(const std::vector<RowMatch>& matches) {
  std::vector<double> differences;
  for (const RowMatch& m : matches) differences.push_back(m.difference_px);
  const double median = medianOf(differences);
  for (double& x : differences) x -= median;
  const double scatter = scatterOf(std::move(differences));
  return scatter < std::abs(median) ? median * (1 - std::pow(scatter / median, 2)) : 0;
}

/// Tukey's weights about the model of the round before.
std::vector<double> weightsOf(const std::vector<RowMatch>& matches, int round,
                              const RowAlignment& alignment) {
  std::vector<double> values = residualsOf(matches, alignment);
  const double limit = std::clamp(4.685 * scatterOf(values), kLeastLimitPx,
                                  kMismatchPx * std::max(1, kFirstLimit - round));
  for (double& x : values) x = std::abs(x) < limit ? std::pow(1 - (x / limit) * (x / limit), 2) : 0;
  return values;
}

RowEquations equationsOf(const std::vector<RowMatch>& matches, const std::vector<double>& weights,
                         const RowAlignment& scale) {
  RowEquations equations;
  for (std::size_t i = 0; i < matches.size(); ++i)
    equations.add(termsAt(scale, matches[i].u_right_px, matches[i].v_right_px),
                  matches[i].difference_px, weights[i]);
  // Few matches must not bend the image: slopes have a small cost, curvature a larger one.
  equations.normal.diagonal() += (Terms() << 0.1, 2, 2, 8, 8, 8).finished();
  return equations;
}

std::array<double, 6> refit(const std::vector<RowMatch>& matches, double common_px, int round,
                            const RowAlignment& alignment) {
  const std::vector<double> weights = weightsOf(matches, round, alignment);
  RowEquations equations = equationsOf(matches, weights, alignment);
  CellCounts cells(alignment);
  for (std::size_t i = 0; i < matches.size(); ++i) cells.add(matches[i], weights[i]);
  cells.addEmptyCells(alignment, common_px, equations);
  const Terms solved = equations.normal.ldlt().solve(equations.rhs);
  std::array<double, 6> model;
  std::copy_n(solved.data(), 6, model.begin());
  return model;
}

}  // namespace

RowAlignment withModel(const RowPlane& plane, RowAlignment scale) {
  scale.model = {plane.centre_px, plane.per_column * scale.half_width_px,
                 plane.per_row * scale.half_width_px};
  return scale;
}

RowAlignment fitRowModel(std::vector<RowMatch> matches, RowAlignment alignment,
                         const RowPlane& expected) {
  if (matches.size() < RowAlignment::kFewestMatches) return alignment;
  const RowAlignment plane = withModel(expected, alignment);
  subtract(plane, &matches);
  const double common_px = commonDifference(matches);
  alignment.model[0] = common_px;
  for (int round = 0; round < kRounds; ++round)
    alignment.model = refit(matches, common_px, round, alignment);
  const std::vector<double> residuals = residualsOf(matches, alignment);
  for (std::size_t k = 0; k < plane.model.size(); ++k) alignment.model[k] += plane.model[k];
  const auto agrees = [](double px) { return std::abs(px) < RowAlignment::kAgreesPx; };
  alignment.agreeing_share =
      static_cast<double>(std::count_if(residuals.begin(), residuals.end(), agrees)) /
      static_cast<double>(residuals.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (std::abs(residuals[i]) > kMismatchPx) continue;
    ++alignment.matches;
    alignment.residual_px += std::abs(residuals[i]);
    alignment.mean_row_difference_px +=
        std::abs(matches[i].difference_px + plane.at(matches[i].u_right_px, matches[i].v_right_px));
  }
  if (alignment.matches == 0) return alignment;
  alignment.residual_px /= alignment.matches;
  alignment.mean_row_difference_px /= alignment.matches;
  return alignment;
}

RowPlane fitRowPlane(std::vector<RowMatch> matches, RowAlignment scale, const RowPlane& expected) {
  const RowAlignment plane = withModel(expected, scale);
  subtract(plane, &matches);
  std::vector<double> differences;
  for (const RowMatch& m : matches) differences.push_back(m.difference_px);
  scale.model = {medianOf(std::move(differences))};
  for (int round = 0; round < kRounds; ++round) {
    const RowEquations equations = equationsOf(matches, weightsOf(matches, round, scale), scale);
    const Eigen::Vector3d solved =
        equations.normal.topLeftCorner<3, 3>().ldlt().solve(equations.rhs.head<3>());
    std::copy_n(solved.data(), 3, scale.model.begin());
  }
  for (std::size_t k = 0; k < 3; ++k) scale.model[k] += plane.model[k];
  return scale.plane();
}

}  // namespace softscope
