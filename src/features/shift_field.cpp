#include "features/shift_field.h"

#include <algorithm>
#include <cmath>

#include "features/match_formulas.h"

namespace softscope {
namespace {

/// Sum of shifts and number of matches, per square.
struct Sum {
  Eigen::Vector2f shift_px = Eigen::Vector2f::Zero();
  float count = 0;
};

Raster<Sum> halved(const Raster<Sum>& fine) {
  Raster<Sum> coarse((fine.width_px + 1) / 2, (fine.height_px + 1) / 2);
  for (int v = 0; v < fine.height_px; ++v)
    for (int u = 0; u < fine.width_px; ++u) {
      coarse.at(u / 2, v / 2).shift_px += fine.at(u, v).shift_px;
      coarse.at(u / 2, v / 2).count += fine.at(u, v).count;
    }
  return coarse;
}

/// Means of the squares; empty squares get the mean of the coarser level.
Raster<Eigen::Vector2f> filledMeans(const Raster<Sum>& sums) {
  Raster<Eigen::Vector2f> means(sums.width_px, sums.height_px, Eigen::Vector2f::Zero());
  Raster<Eigen::Vector2f> coarser;
  if (sums.width_px > 1 || sums.height_px > 1) coarser = filledMeans(halved(sums));
  for (int v = 0; v < sums.height_px; ++v)
    for (int u = 0; u < sums.width_px; ++u) {
      const Sum& sum = sums.at(u, v);
      if (sum.count > 0)
        means.at(u, v) = sum.shift_px / sum.count;
      else if (!coarser.empty())
        means.at(u, v) = coarser.at(u / 2, v / 2);
    }
  return means;
}

}  // namespace

ShiftField::ShiftField(const std::vector<PixelMatch>& matches, int width_px, int height_px,
                       int square_px)
    : square_px_(square_px) {
  if (matches.empty()) return;
  Raster<Sum> sums((width_px + square_px - 1) / square_px, (height_px + square_px - 1) / square_px);
  for (const PixelMatch& match : matches) {
    const int u = squareOf(match.model_px.x(), square_px, sums.width_px),
              v = squareOf(match.model_px.y(), square_px, sums.height_px);
    sums.at(u, v).shift_px += match.live_px - match.model_px;
    sums.at(u, v).count += 1;
  }
  shift_px_ = filledMeans(sums);
}

Eigen::Vector2f ShiftField::at(const Eigen::Vector2f& model_px) const {
  if (shift_px_.empty()) return Eigen::Vector2f::Zero();
  const BetweenSquares across = betweenSquares(model_px.x(), square_px_, shift_px_.width_px),
                       down = betweenSquares(model_px.y(), square_px_, shift_px_.height_px);
  Eigen::Vector2f shift;
  for (int axis = 0; axis < 2; ++axis)
    shift[axis] = mixSquares(
        shift_px_.at(across.first, down.first)[axis], shift_px_.at(across.second, down.first)[axis],
        shift_px_.at(across.first, down.second)[axis],
        shift_px_.at(across.second, down.second)[axis], across.share, down.share);
  return shift;
}

}  // namespace softscope
