// cuda/match/match_images.h: kernel bodies that prepare the images of matching: masks, pyramid,
// smoothing.
#pragma once

#include "core/image.h"
#include "cuda/device/kernel.h"
#include "cuda/device/squares.h"
#include "features/match_formulas.h"
#include "features/subpixel_formulas.h"

namespace softscope::cuda {

/// Inputs of a frame besides its images.
struct MatchInputs {
  int has_anchor;  // 0: no anchor image
  int masked[2];   // of the model image, of the live image; 0: the mask is not in use
};

/// 1 for pixels with a dark pixel of the row within the reach; z: model, live.
struct DarkInRowBody {
  View<const std::uint8_t> gray[2];
  View<std::uint8_t> out[2];
  int darkest_gray, reach;
  SOFTSCOPE_HD void operator()(int u, int v, int image) const {
    std::uint8_t found = 0;
    for (int x = u - reach; x <= u + reach; ++x)
      if (x >= 0 && x < gray[image].width)
        found |= isDark(gray[image].at(x, v), darkest_gray) ? 1 : 0;
    out[image].at(u, v) = found;
  }
};
/// Adds the mask of the image.
struct IgnoreBody {
  View<const std::uint8_t> dark_in_row[2], mask[2];
  View<std::uint8_t> ignore[2];
  const MatchInputs* inputs;
  int reach;
  SOFTSCOPE_HD void operator()(int u, int v, int image) const {
    std::uint8_t found = 0;
    for (int y = v - reach; y <= v + reach; ++y)
      if (y >= 0 && y < ignore[image].height) found |= dark_in_row[image].at(u, y);
    if (inputs->masked[image] != 0 && mask[image].at(u, v) != 0) found = 1;
    ignore[image].at(u, v) = found;
  }
};

constexpr int kMostMatchLevels = 10;

/// Images per level; the third is the anchor of the model.
constexpr int kMatchImages = 3;

/// Half the width and height; z: model, live, anchor.
struct HalveMatchBody {
  View<const std::uint8_t> gray[kMatchImages], ignore[2];
  View<std::uint8_t> half_gray[kMatchImages], half_ignore[2];
  const MatchInputs* inputs;
  SOFTSCOPE_HD void operator()(int u, int v, int image) const {
    if (image == 2 && inputs->has_anchor == 0) return;
    half_gray[image].at(u, v) = meanOfSquare(gray[image], u, v);
    if (image == 2) return;
    half_ignore[image].at(u, v) = bitsOfSquare(ignore[image], u, v) != 0 ? 1 : 0;
  }
};

/// 3 x 3 binomial filter; z: model, live, anchor.
struct BinomialBody {
  View<const std::uint8_t> gray[kMatchImages];
  View<float> smooth[kMatchImages];
  const MatchInputs* inputs;
  SOFTSCOPE_HD void operator()(int u, int v, int image) const {
    if (image == 2 && inputs->has_anchor == 0) return;
    const View<const std::uint8_t>& in = gray[image];
    const std::uint8_t* above = in.row(v > 0 ? v - 1 : 0);
    const std::uint8_t* here = in.row(v);
    const std::uint8_t* below = in.row(v + 1 < in.height ? v + 1 : v);
    const auto column = [&](int x) { return above[x] + 2 * here[x] + below[x]; };
    smooth[image].at(u, v) =
        binomial(column(u > 0 ? u - 1 : 0), column(u), column(u + 1 < in.width ? u + 1 : u));
  }
};

}  // namespace softscope::cuda
