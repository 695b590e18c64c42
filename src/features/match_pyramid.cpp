#include "features/match_pyramid.h"

#include <algorithm>

#include "features/match_formulas.h"

namespace softscope {

MatchPicture halved(const MatchPicture& fine) {
  return {halve(fine.gray), halvedMask(fine.ignore), halve(fine.anchor)};
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
  for (PixelMatch& match : matches) {
    match.model_px = match.model_px.unaryExpr(&toFinerPx);
    match.live_px = match.live_px.unaryExpr(&toFinerPx);
    match.sigma_px *= 2;
  }
  return matches;
}

}  // namespace softscope
