// cuda/view/view_draw.h: kernel bodies of the model view from lists of discs.
#pragma once

#include "core/image.h"
#include "cuda/device/kernel.h"
#include "cuda/view/view_discs.h"
#include "features/view_formulas.h"

namespace softscope::cuda {

/// The view's rasters.
struct ViewImages {
  View<Rgb8> colour;
  View<std::uint8_t> anchor;
  View<float> depth;  // NaN without a surface
  View<std::int32_t> point;
};

/// One block per tile, one thread per pixel: nearest surface
/// first, then the sums of its discs, in the order of the points.
struct DrawTilesKernel {
  static constexpr int kSide = DiscTiles::kSide, kThreads = kSide * kSide, kPhases = 2;
  struct Drawn {
    SplatDisc disc;
    int u0, u1, v0, v1;
    float radius_sq, inverse_radius_sq;
  };
  struct Shared {
    Drawn discs[kThreads];
  };
  struct Local {
    float front;
    float weight, looks[kLooks], inverse_depth, shift_u, shift_v, best_weight;
    std::int32_t point;
  };
  DiscTiles tiles;
  const SplatDisc* discs;
  View<BlendedPixel> blended;
  View<float> depth;
  View<std::int32_t> point;
  float tolerance_mm;

  Grid blocks() const { return {tiles.columns, tiles.rows, 1}; }
  SOFTSCOPE_HD int start(const Place& at) const { return at.y * tiles.columns + at.x; }
  /// At least one, so that every pixel is written.
  SOFTSCOPE_HD int chunks(const Place& at) const {
    const int count = tiles.starts[start(at) + 1] - tiles.starts[start(at)];
    return count > 0 ? (count + kThreads - 1) / kThreads : 1;
  }
  SOFTSCOPE_HD int repeats(const Place& at) const { return 2 * chunks(at); }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const int chunk = at.repeat % chunks(at);
    const int first = tiles.starts[start(at)] + chunk * kThreads;
    const int rest = tiles.starts[start(at) + 1] - first, count = rest < kThreads ? rest : kThreads;
    if constexpr (kPhase == 0) {
      if (at.thread < count)
        shared.discs[at.thread] = drawn(discs[tiles.sorted[first + at.thread]]);
      if (at.repeat == 0) local = {0, 0, {0, 0, 0, 0}, 0, 0, 0, 0, -1};
    } else {
      const int u = at.x * kSide + at.thread % kSide, v = at.y * kSide + at.thread / kSide;
      for (int k = 0; k < count; ++k) {
        const Drawn& disc = shared.discs[k];
        if (u < disc.u0 || u > disc.u1 || v < disc.v0 || v > disc.v1) continue;
        const int group = (u - disc.u0) / kSplatLanes * kSplatLanes;
        const float x = static_cast<float>(u - disc.u0 - group) +
                        (static_cast<float>(disc.u0 + group) - disc.disc.u_px);
        const float y = static_cast<float>(v) - disc.disc.v_px;
        if (at.repeat < chunks(at))
          bringForward(disc, x, y, local);
        else
          blend(disc, x, y, local);
      }
      if (at.repeat + 1 == repeats(at) && blended.contains(u, v)) develop(u, v, local);
    }
  }

 private:
  SOFTSCOPE_HD static Drawn drawn(const SplatDisc& disc) {
    const DiscBox box = discBox(disc);
    const float radius_sq = disc.radius_px * disc.radius_px;
    return {disc,      box.u0,       box.u0 + box.groups * kSplatLanes - 1, box.v0, box.v1,
            radius_sq, 1 / radius_sq};
  }
  SOFTSCOPE_HD static void bringForward(const Drawn& drawn, float x, float y, Local& local) {
    const float near = discInverseDepth(drawn.disc, x, y);
    if (x * x + y * y < drawn.radius_sq && near > local.front) local.front = near;
  }
  SOFTSCOPE_HD void blend(const Drawn& drawn, float x, float y, Local& local) const {
    const SplatDisc& disc = drawn.disc;
    const float near = discInverseDepth(disc, x, y);
    const float falloff = discFalloff(x, y, drawn.inverse_radius_sq);
    if (!(falloff > 0 && near >= frontLimit(local.front, tolerance_mm))) return;
    const float w = falloff * falloff;
    local.weight += w;
    const float looks[kLooks] = {disc.red, disc.green, disc.blue, disc.anchor};
    for (int k = 0; k < kLooks; ++k) local.looks[k] += w * looks[k];
    local.inverse_depth += w * near;
    local.shift_u += w * x;
    local.shift_v += w * y;
    if (!(w > local.best_weight)) return;
    local.best_weight = w;
    local.point = disc.point;
  }
  SOFTSCOPE_HD void develop(int u, int v, const Local& local) const {
    BlendedPixel pixel{};
    const bool seen = local.weight > 0;
    if (seen) {
      const float scale = 1 / local.weight;
      for (int k = 0; k < kLooks; ++k) pixel.looks[k] = scale * local.looks[k];
      pixel.shift_u = scale * local.shift_u;
      pixel.shift_v = scale * local.shift_v;
    }
    blended.at(u, v) = pixel;
    depth.at(u, v) = seen ? local.weight / local.inverse_depth : quietNan();
    point.at(u, v) = seen ? local.point : -1;
  }
};

/// Shifts the colours of each pixel from their mean position to the pixel centre.
struct StraightenBody {
  View<const BlendedPixel> blended;
  View<const float> depth;
  View<Rgb8> colour;
  View<std::uint8_t> anchor;
  float surface_depth_mm;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    BlendedPixel pixel = blended.at(u, v);
    if (u > 0 && v > 0 && u + 1 < blended.width && v + 1 < blended.height) {
      move(u - 1, v, u + 1, v, pixel.shift_u, pixel.looks);
      move(u, v - 1, u, v + 1, pixel.shift_v, pixel.looks);
    }
    Rgb8& out = colour.at(u, v);
    out.red = looksByte(pixel.looks[0]);
    out.green = looksByte(pixel.looks[1]);
    out.blue = looksByte(pixel.looks[2]);
    anchor.at(u, v) = looksByte(pixel.looks[3]);
  }

 private:
  SOFTSCOPE_HD void move(int u0, int v0, int u1, int v1, float shift_px,
                         float (&looks)[kLooks]) const {
    if (!isOneSurface(depth.at(u0, v0), depth.at(u1, v1), surface_depth_mm)) return;
    for (int k = 0; k < kLooks; ++k)
      looks[k] =
          movedLooks(looks[k], shift_px, blended.at(u0, v0).looks[k], blended.at(u1, v1).looks[k]);
  }
};

// --- gaps ------------------------------------------------------------------------------------

/// Width of the gap that begins at a pixel; 0: none.
struct FindGapsBody {
  View<const float> depth;
  View<std::uint8_t> lengths;
  int gap_px;
  float step_mm;
  bool along_rows;

  SOFTSCOPE_HD float at(int u, int v, int offset) const {
    return along_rows ? depth.at(u + offset, v) : depth.at(u, v + offset);
  }
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int room = along_rows ? depth.width - u : depth.height - v;
    const float here = depth.at(u, v);
    std::uint8_t length = 0;
    if (room > 2 && endsSurface(here, at(u, v, 1), step_mm))
      for (int k = 2; k <= gap_px + 1 && k < room; ++k)
        if (continuesSurface(here, at(u, v, k), step_mm)) {
          length = static_cast<std::uint8_t>(k);
          break;
        }
    lengths.at(u, v) = length;
  }
};
/// Fills a gap with the straight surface between both ends, which are outside of gaps.
struct BridgeGapsBody {
  View<const std::uint8_t> lengths;
  ViewImages view;
  int gap_px;
  bool along_rows;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int place = along_rows ? u : v;
    for (int k = 1; k <= gap_px && k <= place; ++k) {
      const int bu = along_rows ? u - k : u, bv = along_rows ? v : v - k;
      const int length = lengths.at(bu, bv);
      if (length <= k || !isBridged(u, v, place - k)) continue;
      bridge(u, v, bu, bv, along_rows ? bu + length : u, along_rows ? v : bv + length,
             shareOfGap(0, k, length));
      return;
    }
  }

 private:
  /// Width of the gap at a position on the line of the pixel.
  SOFTSCOPE_HD int lengthAt(int u, int v, int place) const {
    return along_rows ? lengths.at(place, v) : lengths.at(u, place);
  }
  /// Whether a gap counts: one that begins inside another counted gap does
  /// not. Gaps overlap in short chains; the first one of a chain counts.
  SOFTSCOPE_HD bool isBridged(int u, int v, int place) const {
    int first = place;
    for (int k = 1; k <= gap_px && k <= first; ++k)
      if (lengthAt(u, v, first - k) > k) {
        first -= k;
        k = 0;
      }
    int end = 0;
    for (int i = first; i < place; ++i)
      if (i >= end && lengthAt(u, v, i) > 0) end = i + lengthAt(u, v, i);
    return place >= end;
  }
  SOFTSCOPE_HD void bridge(int u, int v, int bu, int bv, int eu, int ev, float share) const {
    const Rgb8 a = view.colour.at(bu, bv), b = view.colour.at(eu, ev);
    view.depth.at(u, v) = depthInGap(view.depth.at(bu, bv), view.depth.at(eu, ev), share);
    Rgb8& out = view.colour.at(u, v);
    out.red = mixBytes(a.red, b.red, share);
    out.green = mixBytes(a.green, b.green, share);
    out.blue = mixBytes(a.blue, b.blue, share);
    view.anchor.at(u, v) = mixBytes(view.anchor.at(bu, bv), view.anchor.at(eu, ev), share);
    view.point.at(u, v) = share < 0.5f ? view.point.at(bu, bv) : view.point.at(eu, ev);
  }
};

}  // namespace softscope::cuda
