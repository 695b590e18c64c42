// cuda/comparison/comparison_pixels.h: kernel bodies that compare the drawn model with a frame,
// pixel by pixel.
#pragma once

#include "cuda/comparison/comparison_points.h"
#include "fusion/sight.h"
#include "fusion/view_evidence.h"

namespace softscope::cuda {

/// A block per block of the image: whether depths agree, and sums for the correlation of the
/// model's brightness with the image's.
struct EvidenceKernel {
  static constexpr int kThreads = 256, kPhases = 3;
  struct Shared {
    BlockSums sums;
    std::int32_t compared_px, agreeing_px;
    std::uint32_t differences;
    FixedSum difference_mm, absolute_mm;
  };
  using Local = Nothing;
  ComparisonFrameLayout frame;
  ComparisonModelLayout model;
  PosedCamera camera;
  float depth_step;
  int shift_px;
  bool compares_images;

  Grid blocks() const { return {frame.block_columns, frame.block_rows, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    constexpr int kWords = static_cast<int>(sizeof(BlockSums) / sizeof(std::uint32_t));
    static_assert(kWords <= kThreads, "a thread per word");
    const int block = at.y * frame.block_columns + at.x;
    if constexpr (kPhase == 0) {
      if (at.thread < kWords) reinterpret_cast<std::uint32_t*>(&shared.sums)[at.thread] = 0;
      if (at.thread > 0) return;
      shared.compared_px = shared.agreeing_px = 0;
      shared.differences = 0;
      shared.difference_mm = shared.absolute_mm = 0;
    } else if constexpr (kPhase == 1) {
      for (int k = at.thread; k < frame.block_px * frame.block_px; k += kThreads) {
        const int u = at.x * frame.block_px + k % frame.block_px;
        const int v = at.y * frame.block_px + k / frame.block_px;
        if (u >= frame.width || v >= frame.height) continue;
        const float difference_mm = compare(u, v, &shared);
        frame.differences_mm[v * frame.width + u] = difference_mm;
        if (!std::isfinite(difference_mm)) continue;
        const float absolute_mm = std::abs(difference_mm);
        atomicPlus(&shared.differences, 1u);
        atomicPlus(&shared.difference_mm, toFixed(difference_mm));
        atomicPlus(&shared.absolute_mm, toFixed(absolute_mm));
        atomicPlus(&frame.rank_counts[floatAsBits(absolute_mm) >> rankShift(0)], 1u);
      }
    } else {
      if (at.thread < kWords)
        reinterpret_cast<std::uint32_t*>(&frame.evidence[block])[at.thread] =
            reinterpret_cast<const std::uint32_t*>(&shared.sums)[at.thread];
      if (at.thread > 0) return;
      atomicPlus(&frame.totals->compared_px, shared.compared_px);
      atomicPlus(&frame.totals->agreeing_px, shared.agreeing_px);
      atomicPlus(&frame.totals->differences, shared.differences);
      atomicPlus(&frame.totals->difference_mm, shared.difference_mm);
      atomicPlus(&frame.totals->absolute_mm, shared.absolute_mm);
    }
  }

 private:
  /// Depth of the model minus the measured depth, mm; NaN if not comparable.
  SOFTSCOPE_HD float compare(int u, int v, Shared* shared) const {
    const int pixel = v * frame.width + u;
    const unsigned long long held = frame.drawn[pixel];
    if (frame.states[pixel] != PixelState::kAccepted || held == DrawnPoints::kNoPoint)
      return quietNan();
    const std::int32_t i = DrawnPoints::pointOf(held);
    const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
    const float cosine = cosineToRay(left, camera.left_from_world * model.normals[i]);
    if (liesBehind(bitsAsFloat(frame.drawn_cells[frame.cellOf(pixel)]),
                   ComparisonFrameLayout::kCellPx, left.z(), cosine, camera.fx_px,
                   DrawnPoints::kHideMm))
      return quietNan();
    const float measured_mm = frame.depth_mm[pixel];
    if (compares_images) {
      atomicPlus(&shared->compared_px, 1);
      const float sigma_mm = frame.has_sigma ? frame.sigma_mm[pixel] : 0.0f;
      if (depthsAgree(left.z(), measured_mm, sigma_mm, depth_step))
        atomicPlus(&shared->agreeing_px, 1);
      if (frame.has_colour)
        addToBlock(frame, toGray(model.colours[i]), u, v, shift_px, &shared->sums,
                   [](std::uint32_t* word, std::uint32_t value) { atomicPlus(word, value); });
    }
    const Eigen::Vector3f lifted = camera.ray(u, v) * measured_mm;
    return left.z() - measuredDepth(left, lifted, frame.normals[pixel]);
  }
};

/// Counts of the next bits of those differences that have the bits found so far.
struct CountRankBody {
  ComparisonFrameLayout frame;
  int step;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const float difference_mm = frame.differences_mm[v * frame.width + u];
    if (!std::isfinite(difference_mm)) return;
    const int bin = rankBin(difference_mm, step, frame.totals->rank);
    if (bin >= 0) atomicPlus(&frame.rank_counts[step * kRankBins + bin], 1u);
  }
};

}  // namespace softscope::cuda
