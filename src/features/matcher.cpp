#include "features/matcher.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "core/mask_morphology.h"
#include "core/median.h"
#include "core/parallel.h"
#include "features/descriptor_matching.h"
#include "features/feature_settings.h"
#include "features/kernels.h"
#include "features/match_consistency.h"
#include "features/match_formulas.h"
#include "features/match_pyramid.h"
#include "features/opencv_matchers.h"
#include "features/shift_field.h"
#include "features/subpixel_match.h"

namespace softscope {
namespace {

void requireOneShape(const MatchPicture& model, const MatchPicture& live) {
  const auto shape = [](const auto& raster) {
    return std::to_string(raster.width_px) + " x " + std::to_string(raster.height_px);
  };
  if (!model.gray.sameShape(live.gray))
    throw Error("matching: the model view is " + shape(model.gray) + " and the live image " +
                shape(live.gray) + "; both need one shape");
  if (!model.anchor.empty() && !model.anchor.sameShape(model.gray))
    throw Error("matching: the anchor is " + shape(model.anchor) + ", but the model view " +
                shape(model.gray));
  for (const MatchPicture* picture : {&model, &live})
    if (!picture->ignore.empty() && !picture->ignore.sameShape(picture->gray))
      throw Error("matching: a mask is " + shape(picture->ignore) + ", but its image " +
                  shape(picture->gray));
}

/// `fine`, and the `more` matches in squares of `square_px` without a fine match; by rows.
std::vector<PixelMatch> filledUp(std::vector<PixelMatch> fine, const std::vector<PixelMatch>& more,
                                 int width_px, int height_px, int square_px) {
  Mask taken((width_px + square_px - 1) / square_px, (height_px + square_px - 1) / square_px, 0);
  const auto square = [&](const PixelMatch& match) -> std::uint8_t& {
    return taken.at(static_cast<int>(match.model_px.x()) / square_px,
                    static_cast<int>(match.model_px.y()) / square_px);
  };
  for (const PixelMatch& match : fine) square(match) = 1;
  for (const PixelMatch& match : more)
    if (square(match) == 0) fine.push_back(match);
  std::stable_sort(fine.begin(), fine.end(), [](const PixelMatch& a, const PixelMatch& b) {
    return a.model_px.y() < b.model_px.y() ||
           (a.model_px.y() == b.model_px.y() && a.model_px.x() < b.model_px.x());
  });
  return fine;
}

std::vector<PixelMatch> within(float limit_px, const std::vector<PixelMatch>& matches) {
  std::vector<PixelMatch> kept;
  for (const PixelMatch& match : matches)
    if (match.sigma_px <= limit_px) kept.push_back(match);
  return kept;
}

/// Drops matches with a predicted error above both limit and median: in a blurred image all errors
/// are larger, and the better half is still usable. Squares without a better match keep weaker
/// ones: under glare there is no other evidence of a push.
std::vector<PixelMatch> limitSigma(const std::vector<PixelMatch>& matches,
                                   const SubpixelOptions& limits, int width_px, int height_px,
                                   int square_px) {
  if (matches.empty()) return matches;
  std::vector<float> sigmas;
  for (const PixelMatch& match : matches) sigmas.push_back(match.sigma_px);
  const float limit_px =
      std::max(static_cast<float>(limits.kMaxSigmaPx), medianOf(std::move(sigmas)));
  return filledUp(within(limit_px, matches),
                  within(static_cast<float>(limits.kMaxLoneSigmaPx), matches), width_px, height_px,
                  square_px);
}

/// Coarse to fine: the coarsest level searches the full range, finer levels around
/// the shifts of the previous level. For a level with too weak or too blurred
/// texture, matches of the coarser level are kept, with their larger error.
class DenseSurfMatcher : public FeatureMatcher {
 public:
  explicit DenseSurfMatcher(const MatcherOptions& options) : options_(options) {}
  std::string name() const override { return MatcherOptions::kDenseSurf; }

  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override {
    const std::vector<MatchLevel> levels = matchPyramid(model, live, kLeastMatchSidePx);
    std::vector<PixelMatch> matches;
    ShiftField predicted;
    for (std::size_t k = levels.size(); k-- > 0;) {
      const GrayImage& gray = levels[k].model.gray;
      const double radius_px = k + 1 == levels.size()
                                   ? options_.reach * std::max(gray.width_px, gray.height_px)
                                   : options_.kSearchRadiusPx;
      const std::vector<PixelMatch> rough = roughMatches(levels[k], predicted, radius_px);
      matches = filledUp(refined(levels[k], rough), toFinerLevel(std::move(matches)), gray.width_px,
                         gray.height_px, options_.kCoarseSpacingPx);
      if (k > 0)
        predicted = ShiftField(toFinerLevel(keepConsistent(rough, options_.consistency)),
                               levels[k - 1].model.gray.width_px,
                               levels[k - 1].model.gray.height_px, kPredictionSquarePx);
    }
    return matches;
  }

 private:
  std::vector<PixelMatch> roughMatches(const MatchLevel& level, const ShiftField& predicted,
                                       double radius_px) const {
    const DenseSurfOptions& surf = options_.dense_surf;
    const bool whole_nodes = options_.subpixel.method == "none";
    std::vector<PixelMatch> rough;
    for (const NodeMatch& node : matchDescriptors(
             denseSurf(level.model.gray, level.model.ignore, surf),
             denseSurf(level.live.gray, level.live.ignore, surf), predicted, radius_px, options_))
      rough.push_back({node.model_px, whole_nodes ? node.live_px : node.parabola_px,
                       0.5f * static_cast<float>(surf.kGridPx), 0});
    return rough;
  }

  std::vector<PixelMatch> refined(const MatchLevel& level,
                                  const std::vector<PixelMatch>& rough) const {
    if (options_.subpixel.method != "gauss-newton") return rough;
    return keepConsistent(
        limitSigma(refineMatches(level.model, level.live, rough, options_.subpixel),
                   options_.subpixel, level.model.gray.width_px, level.model.gray.height_px,
                   options_.kCoarseSpacingPx),
        options_.consistency);
  }

  MatcherOptions options_;
};

class NoMatcher : public FeatureMatcher {
 public:
  std::string name() const override { return MatcherOptions::kNoMatches; }
  std::vector<PixelMatch> match(const MatchPicture&, const MatchPicture&) override { return {}; }
};

/// Image with its dark pixels ignored as well: they are the unlit background,
/// whose edge with the tissue moves with the silhouette, not with the tissue.
MatchPicture withoutDark(const MatchPicture& picture, const MatcherOptions& options) {
  const int width = picture.gray.width_px, height = picture.gray.height_px;
  Mask dark(width, height, 0);
  parallelRows(height, [&](int v) {
    const std::uint8_t* gray = picture.gray.row(v);
    std::uint8_t* mark = dark.row(v);
    for (int u = 0; u < width; ++u) mark[u] = isDark(gray[u], options.kDarkestGray);
  });
  MatchPicture out{picture.gray, dilated(dark, options.kDarkMarginPx), picture.anchor};
  if (picture.ignore.empty()) return out;
  parallelRows(height, [&](int v) {
    const std::uint8_t* ignore = picture.ignore.row(v);
    std::uint8_t* mark = out.ignore.row(v);
    for (int u = 0; u < width; ++u) mark[u] = ignore[u] != 0 ? std::uint8_t{1} : mark[u];
  });
  return out;
}

/// Common part of all matchers: checks of sizes, mask of dark pixels.
class CheckedMatcher : public FeatureMatcher {
 public:
  CheckedMatcher(const MatcherOptions& options, std::unique_ptr<FeatureMatcher> inner)
      : options_(options), inner_(std::move(inner)) {}
  std::string name() const override { return inner_->name(); }

  std::vector<PixelMatch> match(const MatchPicture& model, const MatchPicture& live) override {
    requireOneShape(model, live);
    return inner_->match(withoutDark(model, options_), withoutDark(live, options_));
  }

 private:
  MatcherOptions options_;
  std::unique_ptr<FeatureMatcher> inner_;
};

/// All matchers, by the name in settings.
struct NamedFeatureMatcher {
  const char* name;
  std::unique_ptr<FeatureMatcher> (*make)(const MatcherOptions&);
};
const NamedFeatureMatcher kMatchers[] = {
    {MatcherOptions::kDenseSurf,
     [](const MatcherOptions& options) -> std::unique_ptr<FeatureMatcher> {
       return std::make_unique<DenseSurfMatcher>(options);
     }},
    {MatcherOptions::kSift, makeSiftMatcher},
    {MatcherOptions::kDisFlow, makeFlowMatcher},
    {MatcherOptions::kNoMatches, [](const MatcherOptions&) -> std::unique_ptr<FeatureMatcher> {
       return std::make_unique<NoMatcher>();
     }}};

}  // namespace

std::vector<std::string> matcherMethods() {
  std::vector<std::string> names;
  for (const NamedFeatureMatcher& matcher : kMatchers) names.emplace_back(matcher.name);
  return names;
}

void MatcherOptions::validate() const { requireAllowed(*this); }

std::unique_ptr<FeatureMatcher> makeFeatureMatcher(const MatcherOptions& options) {
  options.validate();
  const auto named = [&](const NamedFeatureMatcher& matcher) {
    return options.method == matcher.name;
  };
  const NamedFeatureMatcher& matcher =
      *std::find_if(std::begin(kMatchers), std::end(kMatchers), named);
  return std::make_unique<CheckedMatcher>(options, matcher.make(options));
}

}  // namespace softscope
