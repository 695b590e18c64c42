// cuda/stereo/stereo_relief.h: kernel bodies and order of the relief that the last steps of the
// refinement return.
#pragma once

#include <cmath>
#include <type_traits>

#include "core/between_squares.h"
#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_refinement.h"
#include "stereo/kernels/relief_formulas.h"

namespace softscope::cuda {

/// Weights of a window along rows or columns, as kernel argument.
struct WindowWeights {
  float values[kWidestWindow];
  int reach, spacing;
};

/// Sums of reliefAndNoise() along the columns of windows.
struct ReliefColumnsBody {
  View<const float> planes, disparity, sigma;
  View<float> relief_sq, noise_sq;
  WindowWeights window;
  float model_variance_px2;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    float relief_sum = 0, noise_sum = 0;
    for (int y = -window.reach; y <= window.reach; ++y) {
      const int row = v + window.spacing * y;
      if (!planes.contains(u, row)) continue;
      float relief, noise;
      reliefAndNoise(planes.at(u, row), disparity.at(u, row), sigma.at(u, row), model_variance_px2,
                     &relief, &noise);
      relief_sum += window.values[y + window.reach] * relief;
      noise_sum += window.values[y + window.reach] * noise;
    }
    relief_sq.at(u, v) = relief_sum;
    noise_sq.at(u, v) = noise_sum;
  }
};

/// Sums of squares of the relief.
struct ReliefSquaresBody {
  View<const float> planes, disparity, response;
  View<ReliefSquare> squares;

  SOFTSCOPE_HD void operator()(int x, int y, int) const {
    ReliefSquare sums{};
    for (int v = y * kReliefSquarePx; v < (y + 1) * kReliefSquarePx; ++v)
      for (int u = x * kReliefSquarePx; u < (x + 1) * kReliefSquarePx; ++u)
        if (planes.contains(u, v))
          addPixel(planes.at(u, v), disparity.at(u, v), response.at(u, v), &sums);
    squares.at(x, y) = sums;
  }
};

struct ReliefSquareColumnsBody {
  View<const ReliefSquare> squares;
  View<ReliefSquare> summed;
  WindowWeights window;

  SOFTSCOPE_HD void operator()(int x, int y, int) const {
    summed.at(x, y) = squaresAround(squares, x, y, 0, 1, window.values, window.reach);
  }
};
struct SmoothReliefBody {
  View<const ReliefSquare> summed;
  View<float> relief_px;
  WindowWeights window;

  SOFTSCOPE_HD void operator()(int x, int y, int) const {
    relief_px.at(x, y) =
        smoothRelief(squaresAround(summed, x, y, 1, 0, window.values, window.reach));
  }
};

/// Keeps the share of the relief that reliefGain() gives, from those sums, and of the rest what is
/// smooth.
struct ShrinkReliefBody {
  View<const float> planes, relief_sq, noise_sq, smooth_px;
  View<float> disparity, sigma;
  WindowWeights window;
  float model_variance_px2;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    float relief_sum = 0, noise_sum = 0;
    for (int x = -window.reach; x <= window.reach; ++x) {
      const int column = u + window.spacing * x;
      if (!planes.contains(column, v)) continue;
      relief_sum += window.values[x + window.reach] * relief_sq.at(column, v);
      noise_sum += window.values[x + window.reach] * noise_sq.at(column, v);
    }
    const float gain = reliefGain(relief_sum, noise_sum);
    const float of_planes = planes.at(u, v), of_sigma = sigma.at(u, v);
    const float relief = disparity.at(u, v) - of_planes;
    disparity.at(u, v) = of_planes + keptRelief(relief, smoothAt(u, v), gain);
    sigma.at(u, v) = std::sqrt(varianceWithRelief(of_sigma * of_sigma, gain, model_variance_px2));
  }

 private:
  SOFTSCOPE_HD float smoothAt(int u, int v) const {
    const BetweenSquares x = squaresBeside(u, smooth_px.width),
                         y = squaresBeside(v, smooth_px.height);
    const float *upper = smooth_px.row(y.first), *lower = smooth_px.row(y.second);
    return mixSquares(upper[x.first], upper[x.second], lower[x.first], lower[x.second], x.share,
                      y.share);
  }
  SOFTSCOPE_HD static BetweenSquares squaresBeside(int pixel, int squares) {
    return betweenSquares(static_cast<float>(pixel), kReliefSquarePx, squares);
  }
};

/// Inputs, outputs and room.
struct ReliefPlanes {
  View<const float> planes, response;
  View<float> disparity, sigma;  // replaced
  View<float> relief_sq, noise_sq;
  View<ReliefSquare> squares, columns;
  View<float> smooth_px;
  WindowWeights window;  // in pixels and, without its spacing, in squares
  float model_variance_px2;
};

/// Keeps the relief that was returned to the planes as far as it exceeds noise.
template <class Executor>
void shrinkRelief(Executor& executor, const ReliefPlanes& of) {
  const auto launch = [&](const char* name, const auto& body, int width, int height) {
    const PixelKernel<std::decay_t<decltype(body)>> kernel{body, width, height};
    executor.launch(name, kernel, kernel.grid(1));
  };
  const int columns = of.smooth_px.width, rows = of.smooth_px.height;
  const int width = of.planes.width, height = of.planes.height;
  const View<const float> disparity = readOnly(of.disparity), sigma = readOnly(of.sigma);
  launch("relief squares", ReliefSquaresBody{of.planes, disparity, of.response, of.squares},
         columns, rows);
  launch("columns of squares", ReliefSquareColumnsBody{readOnly(of.squares), of.columns, of.window},
         columns, rows);
  launch("smooth relief", SmoothReliefBody{readOnly(of.columns), of.smooth_px, of.window}, columns,
         rows);
  launch("relief columns",
         ReliefColumnsBody{of.planes, disparity, sigma, of.relief_sq, of.noise_sq, of.window,
                           of.model_variance_px2},
         width, height);
  launch("shrink relief",
         ShrinkReliefBody{of.planes, readOnly(of.relief_sq), readOnly(of.noise_sq),
                          readOnly(of.smooth_px), of.disparity, of.sigma, of.window,
                          of.model_variance_px2},
         width, height);
}

}  // namespace softscope::cuda
