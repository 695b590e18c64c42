// cuda/frame/relief.h: kernel bodies that find the relief that windows level out.
#pragma once

#include "cuda/device/kernel.h"
#include "stereo/depth/relief_formulas.h"

namespace softscope::cuda {

/// Pixels of the windows before and after a pixel, up to kSmoothedReach.
struct ReliefExtent {
  std::uint8_t left, right, up, down;
};

struct ReliefLayout {
  ReliefLayout() = default;
  ReliefLayout(Arena& arena, std::size_t pixels)
      : steps(arena.array<std::uint32_t>(pixels)),
        extents(arena.array<ReliefExtent>(pixels)),
        pairs(arena.array<std::uint64_t>(pixels)),
        rows(arena.array<std::uint64_t>(pixels)),
        error_px(arena.array<float>(pixels)) {}

  std::uint32_t* steps = nullptr;
  ReliefExtent* extents = nullptr;
  std::uint64_t *pairs = nullptr, *rows = nullptr;  // of pixels; summed along rows
  float* error_px = nullptr;
};

struct ReliefStepsBody {
  const float* depth_mm;
  ReliefLayout to;
  int width;
  float scale;  // focal length times baseline

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * width + u;
    const std::uint32_t steps = disparitySteps(depth_mm[pixel], scale);
    to.steps[pixel] = steps;
    to.pairs[pixel] = depth_mm[pixel] > 0 ? reliefPair(steps) : 0;
  }
};

/// Windows end at the border of the image and at steps between measured pixels, whatever lies
/// between them.
struct ReliefExtentsBody {
  ReliefLayout at;
  int width, height;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * width + u;
    at.extents[pixel] = {reach(pixel, -1, u), reach(pixel, 1, width - 1 - u),
                         reach(pixel, -width, v), reach(pixel, width, height - 1 - v)};
  }

 private:
  /// In the direction of `stride`, where `room` pixels follow.
  SOFTSCOPE_HD std::uint8_t reach(int pixel, int stride, int room) const {
    std::uint32_t last = at.steps[pixel];
    int last_away = 0;  // of the last measured pixel, which a step beyond it would end at
    for (int away = 1; away <= room; ++away) {
      // Farther pixels matter only while a measured one within reach waits for its neighbour.
      if (away > kSmoothedReach && (last == 0 || last_away > kSmoothedReach)) break;
      const std::uint32_t here = at.steps[pixel + away * stride];
      if (here == 0) continue;
      if (last != 0 && isReliefStep(last, here)) return static_cast<std::uint8_t>(last_away);
      last = here;
      last_away = away;
    }
    return static_cast<std::uint8_t>(room < kSmoothedReach ? room : kSmoothedReach);
  }
};

/// Sum from `before` places before the middle to `after` behind it.
template <ReliefSides kSides>
SOFTSCOPE_HD inline std::uint64_t reliefSum(const std::uint64_t* middle, int stride, int before,
                                            int after) {
  if (kSides == ReliefSides::kEven) before = after = before < after ? before : after;
  std::uint64_t sum = 0;
  for (int k = -before; k <= after; ++k) sum += middle[k * stride];
  return sum;
}

/// None at pixels that are not measured, which may be in the gap of a step.
template <ReliefSides kSides>
struct ReliefRowsBody {
  ReliefLayout at;
  int width;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * width + u;
    const ReliefExtent& extent = at.extents[pixel];
    at.rows[pixel] = reliefCount(at.pairs[pixel]) == 0
                         ? 0
                         : reliefSum<kSides>(at.pairs + pixel, 1, extent.left, extent.right);
  }
};

/// Squared bends in place of disparities.
struct ReliefBendBody {
  ReliefLayout at;
  int width;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * width + u;
    if (reliefCount(at.pairs[pixel]) == 0) return;
    const ReliefExtent& extent = at.extents[pixel];
    at.pairs[pixel] =
        bendPair(at.steps[pixel],
                 reliefSum<ReliefSides::kEven>(at.rows + pixel, width, extent.up, extent.down));
  }
};

struct ReliefErrorBody {
  ReliefLayout at;
  int width;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * width + u;
    const ReliefExtent& extent = at.extents[pixel];
    at.error_px[pixel] = reliefCount(at.pairs[pixel]) == 0
                             ? quietNan()
                             : reliefErrorOf(reliefSum<ReliefSides::kBoth>(at.rows + pixel, width,
                                                                           extent.up, extent.down));
  }
};

}  // namespace softscope::cuda
