#include "features/match_pyramid.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

/// A pixel is ignored if one of its four is.
Mask halveMask(const Mask& fine) {
  Mask coarse(fine.width_px / 2, fine.height_px / 2);
  parallelRows(coarse.height_px, [&](int v) {
    const std::uint8_t *above = fine.row(2 * v), *below = fine.row(2 * v + 1);
    for (int u = 0; u < coarse.width_px; ++u)
      coarse.at(u, v) =
          (above[2 * u] | above[2 * u + 1] | below[2 * u] | below[2 * u + 1]) != 0 ? 1 : 0;
  });
  return coarse;
}

}  // namespace

MatchPicture halved(const MatchPicture& fine) {
  return {halve(fine.gray), halveMask(fine.ignore), halve(fine.anchor)};
}

std::vector<MatchLevel> matchPyramid(const MatchPicture& model, const MatchPicture& live,
                                     int least_side_px) {
  std::vector<MatchLevel> levels{{model, live}};
  while (std::min(levels.back().model.gray.width_px, levels.back().model.gray.height_px) / 2 >=
         least_side_px)
    levels.push_back({halved(levels.back().model), halved(levels.back().live)});
  return levels;
}

std::vector<PixelMatch> toFinerLevel(std::vector<PixelMatch> matches) {
  const Eigen::Vector2f centre = Eigen::Vector2f::Constant(0.5f);
  for (PixelMatch& match : matches) {
    match.model_px = 2 * match.model_px + centre;
    match.live_px = 2 * match.live_px + centre;
    match.sigma_px *= 2;
  }
  return matches;
}

}  // namespace softscope
