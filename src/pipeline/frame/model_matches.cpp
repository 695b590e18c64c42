// src/pipeline/frame/model_matches.cpp: masks and images.
#include "pipeline/frame/model_matches.h"

#include <utility>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "features/highlight_mask.h"

namespace softscope {
namespace {

void addTo(Mask& mask, const Mask& more) {
  std::uint8_t* to = mask.values.data();
  const std::uint8_t* from = more.values.data();
  const std::size_t count = more.size();
  for (std::size_t i = 0; i < count; ++i)  // no branch: many pixels at a time
    to[i] = from[i] != 0 ? std::uint8_t{1} : to[i];
}

Mask unseen(const ModelView& view) {
  const int width = view.colour.width_px, height = view.colour.height_px;
  Mask ignore(width, height, 0);
  parallelRows(height, [&](int v) {
    const std::int32_t* point = view.point_index.row(v);
    std::uint8_t* mark = ignore.row(v);
    for (int u = 0; u < width; ++u) mark[u] = point[u] < 0;
  });
  return ignore;
}

}  // namespace

Mask notTissue(const ColourImage& left, const MeasuredFrame& frame,
               const TissueMaskOptions& options) {
  Mask mask(left.width_px, left.height_px, 0);
  if (!frame.mask.empty()) {
    addTo(mask, frame.mask);
    for (std::size_t i = 0; i < frame.border.size(); ++i)
      mask.values[i] = frame.border.values[i] != 0 ? std::uint8_t{0} : mask.values[i];
    if (options.margin_px > 0) mask = dilated(mask, options.margin_px);
  }
  addTo(mask, frame.border);  // without a margin: no matching window reached it
  return mask;
}

MatchPicture livePicture(const ColourImage& left, GrayImage gray, const Mask& not_tissue) {
  MatchPicture live{std::move(gray), not_tissue};
  addTo(live.ignore, highlightMask(left));
  return live;
}

MatchPicture modelPicture(const ModelView& view) {
  return {toGray(view.colour), unseen(view), view.anchor};
}

ModelMatches matchModel(const ModelView& view, const MatchPicture& picture,
                        const MatchPicture& live, const MeasuredFrame& frame,
                        FeatureMatcher& matcher) {
  ModelMatches matches;
  matches.pixels = matcher.match(picture, live);
  matches.lifted = liftMatches(matches.pixels, view, frame.depth, view.camera);
  return matches;
}

}  // namespace softscope
