#include "stereo/refinement/smooth_relief.h"

#include <algorithm>

#include "core/between_squares.h"
#include "core/parallel.h"
#include "stereo/kernels/relief_formulas.h"

namespace softscope {
namespace {

ReliefSquare squareAt(const Plane& planes, const Plane& disparity, const Plane& response, int u0,
                      int v0, int u1, int v1) {
  ReliefSquare square{};
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u)
      addPixel(planes.row(v)[u], disparity.row(v)[u], response.row(v)[u], &square);
  return square;
}

}  // namespace

SmoothRelief::SmoothRelief(const Plane& planes, const Plane& disparity, const Plane& response,
                           int width, int height, const std::vector<float>& window)
    : relief_px_(reliefSquares(width), reliefSquares(height)) {
  const int columns = relief_px_.width_px, rows = relief_px_.height_px;
  Raster<ReliefSquare> squares(columns, rows), summed(columns, rows);
  const auto forAll = [&](const auto& visit) {
    parallelRows(rows, [&](int y) {
      for (int x = 0; x < columns; ++x) visit(x, y);
    });
  };
  const int reach = static_cast<int>(window.size()) / 2;
  constexpr int kSide = kReliefSquarePx;
  forAll([&](int x, int y) {
    squares.at(x, y) =
        squareAt(planes, disparity, response, x * kSide, y * kSide,
                 std::min(width, (x + 1) * kSide), std::min(height, (y + 1) * kSide));
  });
  forAll([&](int x, int y) {
    summed.at(x, y) = squaresAround(squares, x, y, 0, 1, window.data(), reach);
  });
  forAll([&](int x, int y) {
    relief_px_.at(x, y) = smoothRelief(squaresAround(summed, x, y, 1, 0, window.data(), reach));
  });
}

void SmoothRelief::row(int v, int width, float* relief_px) const {
  const BetweenSquares y =
      betweenSquares(static_cast<float>(v), kReliefSquarePx, relief_px_.height_px);
  const float *upper = relief_px_.row(y.first), *lower = relief_px_.row(y.second);
  for (int u = 0; u < width; ++u) {
    const BetweenSquares x =
        betweenSquares(static_cast<float>(u), kReliefSquarePx, relief_px_.width_px);
    relief_px[u] = mixSquares(upper[x.first], upper[x.second], lower[x.first], lower[x.second],
                              x.share, y.share);
  }
}

}  // namespace softscope
