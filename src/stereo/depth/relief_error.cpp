#include "stereo/depth/relief_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

// Integer sums: the same in any order of addition. Prefix sums may overflow,
// differences of unsigned ones are right nevertheless.
using Counts = Raster<std::uint32_t>;

constexpr int kSmoothedReach = 2 * RefinementOptions::radius_px;  // two windows in sequence
constexpr float kStepsPerPx = 1024;    // of disparity: 625 times 3355 px fit
constexpr float kStepsAPx2 = 65536;    // of squared bends …
constexpr float kLargestBendPx2 = 50;  // … 625 of which fit
constexpr std::uint32_t kEdge =
    static_cast<std::uint32_t>(StereoOptions::edge_step_px * kStepsPerPx);
constexpr int kReliefBand = 48;  // rows or columns of one task

/// The nearest whole number of one that is not negative, as std::lround(), which is a call.
template <class Real>
std::uint32_t rounded(Real x) {
  const auto whole = static_cast<std::uint32_t>(x);
  return whole + (x - static_cast<Real>(whole) >= Real(0.5) ? 1 : 0);
}

/// Pixels of a window before and after its centre, up to `kSmoothedReach`, in one direction.
struct Extents {
  Raster<std::uint8_t> before, after;
};

bool isStep(std::uint32_t a, std::uint32_t b) { return (a > b ? a - b : b - a) > kEdge; }

/// Counts pixels since the last depth step between measured pixels.
class StepFreeRun {
 public:
  std::uint8_t extend(std::uint32_t disparity) {
    length_ = std::min(length_ + 1, kSmoothedReach + 1);
    if (disparity != 0) {
      if (last_ != 0 && isStep(disparity, last_)) length_ = 1;
      last_ = disparity;
    }
    return static_cast<std::uint8_t>(length_ - 1);
  }

 private:
  int length_ = 0;
  std::uint32_t last_ = 0;  // disparity of the last measured pixel; 0: none
};

/// Windows end at the border of the image and at depth steps.
Extents extentsAlongRows(const Counts& disparity) {
  Extents extents{{disparity.width_px, disparity.height_px},
                  {disparity.width_px, disparity.height_px}};
  parallelRows(disparity.height_px, [&](int v) {
    StepFreeRun rightwards, leftwards;
    for (int u = 0; u < disparity.width_px; ++u)
      extents.before.at(u, v) = rightwards.extend(disparity.at(u, v));
    for (int u = disparity.width_px - 1; u >= 0; --u)
      extents.after.at(u, v) = leftwards.extend(disparity.at(u, v));
  });
  return extents;
}

Extents extentsAlongColumns(const Counts& disparity) {
  const int height = disparity.height_px;
  Extents extents{{disparity.width_px, height}, {disparity.width_px, height}};
  parallelRanges(disparity.width_px, kReliefBand, [&](int begin, int end) {
    std::vector<StepFreeRun> downwards(static_cast<std::size_t>(end - begin)),
        upwards(static_cast<std::size_t>(end - begin));
    for (int v = 0; v < height; ++v)
      for (int u = begin; u < end; ++u)
        extents.before.at(u, v) =
            downwards[static_cast<std::size_t>(u - begin)].extend(disparity.at(u, v));
    for (int v = height - 1; v >= 0; --v)
      for (int u = begin; u < end; ++u)
        extents.after.at(u, v) =
            upwards[static_cast<std::size_t>(u - begin)].extend(disparity.at(u, v));
  });
  return extents;
}

/// Both sides as far as the shorter one: a plane is then the mean of its window in its middle.
Extents symmetric(const Extents& extents) {
  Extents both = extents;
  parallelRows(both.before.height_px, [&](int v) {
    std::uint8_t *before = both.before.row(v), *after = both.after.row(v);
    for (int u = 0; u < both.before.width_px; ++u)
      before[u] = after[u] = std::min(before[u], after[u]);
  });
  return both;
}

/// None at pixels without `disparity`, which may be in the gap of a step.
Counts sumsAlongRows(const Counts& in, const Extents& extents, const Counts& disparity) {
  Counts out(in.width_px, in.height_px);
  parallelRanges(in.height_px, kReliefBand, [&](int begin, int end) {
    std::vector<std::uint32_t> prefix(static_cast<std::size_t>(in.width_px) + 1, 0);
    for (int v = begin; v < end; ++v) {
      const std::uint32_t* from = in.row(v);
      for (int u = 0; u < in.width_px; ++u) prefix[u + 1] = prefix[u] + from[u];
      const std::uint8_t *before = extents.before.row(v), *after = extents.after.row(v);
      const std::uint32_t* is_measured = disparity.row(v);
      std::uint32_t* to = out.row(v);
      for (int u = 0; u < in.width_px; ++u)
        to[u] = is_measured[u] != 0 ? prefix[u + 1 + after[u]] - prefix[u - before[u]] : 0;
    }
  });
  return out;
}

Counts sumsAlongColumns(const Counts& in, const Extents& extents) {
  Counts prefix(in.width_px, in.height_px + 1, 0), out(in.width_px, in.height_px);
  parallelRanges(in.width_px, kReliefBand, [&](int begin, int end) {
    for (int v = 0; v < in.height_px; ++v)
      for (int u = begin; u < end; ++u) prefix.at(u, v + 1) = prefix.at(u, v) + in.at(u, v);
  });
  parallelRows(in.height_px, [&](int v) {
    const std::uint8_t *before = extents.before.row(v), *after = extents.after.row(v);
    std::uint32_t* to = out.row(v);
    for (int u = 0; u < in.width_px; ++u)
      to[u] = prefix.at(u, v + 1 + after[u]) - prefix.at(u, v - before[u]);
  });
  return out;
}

/// Windows around each pixel that end at depth steps: Zhang, Lu and Lafruit, "Cross-based local
/// stereo matching using orthogonal integral images", 2009.
struct Windows {
  Extents rows, columns;
};

Windows windowsOf(const Counts& disparity) {
  Windows windows;
  parallelInvoke([&] { windows.rows = extentsAlongRows(disparity); },
                 [&] { windows.columns = extentsAlongColumns(disparity); });
  return windows;
}

Counts sumsOver(const Windows& windows, const Counts& in, const Counts& disparity) {
  return sumsAlongColumns(sumsAlongRows(in, windows.rows, disparity), windows.columns);
}

}  // namespace

float sigmaWithRelief(const RectifiedRig& rig, float sigma_mm, float depth_mm, float error_px) {
  if (std::isnan(error_px)) return sigma_mm;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  return std::hypot(sigma_mm, depth_mm * depth_mm / scale * error_px);
}

Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  constexpr float kLargest = static_cast<float>(StereoOptions::kLargestDisparityPx);
  Counts measured(width, height, 0), steps(width, height, 0);
  parallelRows(height, [&](int v) {
    const float* z = depth_mm.row(v);
    std::uint32_t *is_measured = measured.row(v), *step = steps.row(v);
    for (int u = 0; u < width; ++u) {
      is_measured[u] = z[u] > 0 ? 1 : 0;
      step[u] = rounded(z[u] > 0 ? kStepsPerPx * std::min(scale / z[u], kLargest) : 0.0f);
    }
  });
  const Windows windows = windowsOf(steps);
  const Windows even{symmetric(windows.rows), symmetric(windows.columns)};
  Counts means_of, means, counts;
  // Independent.
  parallelInvoke([&] { means = sumsOver(even, steps, steps); },
                 [&] {
                   parallelInvoke([&] { means_of = sumsOver(even, measured, steps); },
                                  [&] { counts = sumsOver(windows, measured, steps); });
                 });
  Counts squares(width, height, 0);
  parallelRows(height, [&](int v) {
    const std::uint32_t *is_measured = measured.row(v), *step = steps.row(v), *sum = means.row(v),
                        *count = means_of.row(v);
    std::uint32_t* square = squares.row(v);
    for (int u = 0; u < width; ++u) {
      const double bend_px =
          (step[u] - static_cast<double>(sum[u]) / std::max(count[u], 1U)) / kStepsPerPx;
      square[u] = is_measured[u] *
                  rounded(kStepsAPx2 * std::min<double>(bend_px * bend_px, kLargestBendPx2));
    }
  });
  const Counts energies = sumsOver(windows, squares, steps);
  Raster<float> error_px(width, height, std::numeric_limits<float>::quiet_NaN());
  parallelRows(height, [&](int v) {
    const std::uint32_t *is_measured = measured.row(v), *energy = energies.row(v),
                        *count = counts.row(v);
    float* error = error_px.row(v);
    for (int u = 0; u < width; ++u)
      if (is_measured[u] != 0)
        error[u] =
            std::sqrt(static_cast<float>(energy[u]) / (kStepsAPx2 * static_cast<float>(count[u])));
  });
  return error_px;
}

void addReliefError(const RectifiedRig& rig, DisparityMap* disparity, DepthMap* depth) {
  if (depth->sigma_mm.empty()) return;
  const Raster<float> error_px = reliefErrorPx(depth->depth_mm, rig);
  parallelRows(error_px.height_px, [&](int v) {
    for (int u = 0; u < error_px.width_px; ++u) {
      const float error = error_px.at(u, v);
      if (std::isnan(error)) continue;
      float& sigma_mm = depth->sigma_mm.at(u, v);
      sigma_mm = sigmaWithRelief(rig, sigma_mm, depth->depth_mm.at(u, v), error);
      if (disparity == nullptr || disparity->sigma_px.empty()) continue;
      float& sigma_px = disparity->sigma_px.at(u, v);
      sigma_px = std::hypot(sigma_px, error);
    }
  });
}

}  // namespace softscope
