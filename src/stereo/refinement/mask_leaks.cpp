#include "stereo/refinement/mask_leaks.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/error.h"
#include "core/mask_morphology.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

constexpr int kWindowPx = RefinementOptions::radius_px;
constexpr int kReachPx = 2 * (kWindowPx + 2);  // with the matching window, at half size
constexpr int kLongestWay = kReachPx * 3 / 2;  // in pixels; diagonal steps count as one

struct Pixel {
  int u = 0, v = 0;
};

/// Calls `visit` for the measured neighbours of `pixel` on the same surface.
template <typename Visitor>
void visitSurface(const Raster<float>& disparity_px, const Pixel& pixel, const Visitor& visit) {
  const float here = disparity_px.at(pixel.u, pixel.v);
  for (int v = pixel.v - 1; v <= pixel.v + 1; ++v)
    for (int u = pixel.u - 1; u <= pixel.u + 1; ++u)
      if (disparity_px.contains(u, v) &&
          std::abs(disparity_px.at(u, v) - here) <= ElasOptions::speckle_step_px)  // false for NaN
        visit(Pixel{u, v});
}

}  // namespace

Mask leaksOf(const Mask& mask, const Raster<float>& disparity_px) {
  if (!mask.sameShape(disparity_px)) throw Error("a mask of another size than the disparities");
  Mask leaks = dilated(mask, kReachPx);
  const Mask window = dilated(mask, kWindowPx);
  const Mask rim = dilated(mask, kReachPx + 1);
  std::vector<Pixel> front;
  for (int v = 0; v < mask.height_px; ++v)
    for (int u = 0; u < mask.width_px; ++u) {
      if (rim.at(u, v) == 0) continue;
      if (!std::isfinite(disparity_px.at(u, v)))
        leaks.at(u, v) = 0;
      else if (leaks.at(u, v) == 0)
        front.push_back({u, v});
    }
  for (int way = 0; way < kLongestWay && !front.empty(); ++way) {
    std::vector<Pixel> next;
    for (const Pixel& pixel : front)
      visitSurface(disparity_px, pixel, [&](const Pixel& neighbour) {
        if (leaks.at(neighbour.u, neighbour.v) == 0 || window.at(neighbour.u, neighbour.v) != 0)
          return;
        leaks.at(neighbour.u, neighbour.v) = 0;
        next.push_back(neighbour);
      });
    front = std::move(next);
  }
  return leaks;
}

}  // namespace softscope
