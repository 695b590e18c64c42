// tests/features/matcher_test.cpp: true matches, honest errors, and none where there is nothing.
#include "features/matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "features/warped_pair.h"

namespace softscope {
namespace {

using Eigen::Vector2f;

std::vector<PixelMatch> matchBy(const MatcherOptions& options, const test::WarpedPair& pair) {
  return makeFeatureMatcher(options)->match(pair.model, pair.live);
}

MatcherOptions methodOf(const std::string& method) {
  MatcherOptions options;
  options.method = method;
  return options;
}

bool same(const std::vector<PixelMatch>& a, const std::vector<PixelMatch>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const PixelMatch& x, const PixelMatch& y) {
           return x.model_px == y.model_px && x.live_px == y.live_px && x.sigma_px == y.sigma_px;
         });
}

TEST(DenseSurfMatcher, FindsASmoothDeformationToATenthOfAPixel) {
  const auto errors = test::errorsOf(matchBy({}, test::makeWarpedPair(2.0)));
  EXPECT_GT(errors.count, 1000u);  // of about 1700 squares of 6 px inside both pictures
  EXPECT_LT(errors.median_px, 0.1);
  EXPECT_LT(errors.outlier_share, 0.005);
  // The median of a 2-D Gaussian error is 1.18 standard errors of one axis; sigma_px is the worst
  // axis', so below; a third would be false modesty.
  EXPECT_LT(errors.median_in_sigmas, 1.5);
  EXPECT_GT(errors.median_in_sigmas, 0.4);
}

TEST(DenseSurfMatcher, RefinementIsWorthItsTime) {
  const test::WarpedPair pair = test::makeWarpedPair(2.0);
  double medians[2];
  const char* methods[] = {"none", "gauss-newton"};
  for (int k = 0; k < 2; ++k) {
    MatcherOptions options;
    options.subpixel.method = methods[k];
    medians[k] = test::errorsOf(matchBy(options, pair)).median_px;
  }
  EXPECT_LT(medians[1], 0.1 * medians[0]);
}

/// A pair whose live image has strong noise in the middle.
test::WarpedPair noisyInTheMiddle(double noise_gray) {
  test::WarpedPair pair = test::makeWarpedPair(1.0);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, noise_gray);
  for (int v = 80; v < 180; ++v)
    for (int u = 100; u < 220; ++u) {
      std::uint8_t& gray = pair.live.gray.at(u, v);
      gray = static_cast<std::uint8_t>(std::clamp(std::lround(gray + noise(random)), 0L, 255L));
    }
  return pair;
}

TEST(DenseSurfMatcher, KeepsWeakMatchesWhereThereAreNoBetterOnes) {
  MatcherOptions options;
  const std::vector<PixelMatch> matches = matchBy(options, noisyInTheMiddle(25));
  std::map<std::pair<int, int>, int> good;
  const auto square = [&](const PixelMatch& match) {
    return std::pair(static_cast<int>(match.model_px.x()) / options.kCoarseSpacingPx,
                     static_cast<int>(match.model_px.y()) / options.kCoarseSpacingPx);
  };
  for (const PixelMatch& match : matches)
    if (match.sigma_px <= options.subpixel.kMaxSigmaPx) ++good[square(match)];
  std::vector<PixelMatch> weak;
  for (const PixelMatch& match : matches)
    if (match.sigma_px > options.subpixel.kMaxSigmaPx) {
      weak.push_back(match);
      EXPECT_EQ(good[square(match)], 0);
    }
  EXPECT_GT(weak.size(), 20u);
  EXPECT_LT(test::errorsOf(weak).median_in_sigmas, 1.5);
}

/// The model's texture has slipped by `slip_px` to the right since its anchor was set.
test::WarpedPair slippedPair(double slip_px) {
  test::WarpedPair pair = test::makeWarpedPair(1.0);
  pair.model.anchor = pair.model.gray;
  for (int v = 0; v < pair.model.gray.height_px; ++v)
    for (int u = 0; u < pair.model.gray.width_px; ++u)
      pair.model.gray.at(u, v) =
          static_cast<std::uint8_t>(std::lround(test::textureAt(Eigen::Vector2d(u - slip_px, v))));
  return pair;
}

TEST(Anchor, KeepsThePlacesOfATextureThatSlipped) {
  test::WarpedPair pair = slippedPair(0.6);
  const auto held = test::errorsOf(matchBy({}, pair));
  EXPECT_GT(held.count, 1000u);
  EXPECT_LT(held.median_px, 0.1);
  pair.model.anchor = {};
  EXPECT_GT(test::errorsOf(matchBy({}, pair)).median_px, 0.5);  // no stored anchors
}

// The appearance of the anchor is gone (here: another tissue), so the
// present appearance of the model decides, with a sigma that includes drift.
TEST(Anchor, IsLeftWhereTheTissueLooksDifferent) {
  test::WarpedPair pair = slippedPair(0);
  const auto plain = test::errorsOf(matchBy({}, pair));
  for (int v = 0; v < pair.model.anchor.height_px; ++v)
    for (int u = 0; u < pair.model.anchor.width_px; ++u)
      pair.model.anchor.at(u, v) = static_cast<std::uint8_t>(
          std::lround(test::textureAt(Eigen::Vector2d(u + 900, v - 700))));
  const std::vector<PixelMatch> matches = matchBy({}, pair);
  const auto errors = test::errorsOf(matches);
  EXPECT_GT(errors.count, plain.count * 9 / 10);
  EXPECT_LT(errors.median_px, 0.1);
  const float drift_px = static_cast<float>(SubpixelOptions::kDriftPx);
  int doubted = 0;
  for (const PixelMatch& match : matches) doubted += match.sigma_px >= drift_px;
  EXPECT_GT(doubted, static_cast<int>(matches.size()) * 95 / 100);
}

/// The live image, and its truth, moved by whole pixels; what comes in at the rim is another
/// tissue.
test::WarpedPair movedPair(int right_px, int down_px) {
  test::WarpedPair pair = test::makeWarpedPair(1.0, 480, 360);
  const GrayImage before = pair.live.gray;
  for (int v = 0; v < before.height_px; ++v)
    for (int u = 0; u < before.width_px; ++u)
      pair.live.gray.at(u, v) =
          before.contains(u - right_px, v - down_px)
              ? before.at(u - right_px, v - down_px)
              : static_cast<std::uint8_t>(test::textureAt(Eigen::Vector2d(u + 900, v - 700)));
  return pair;
}

TEST(DenseSurfMatcher, FindsShiftsFarBeyondTheFinestLevelsSearch) {
  const int right_px = 55, down_px = -40;  // the finest level searches 12 px
  std::vector<PixelMatch> matches = matchBy({}, movedPair(right_px, down_px));
  for (PixelMatch& match : matches) match.live_px -= Vector2f(right_px, down_px);
  const auto errors = test::errorsOf(matches);
  EXPECT_GT(errors.count, 2000u);
  EXPECT_LT(errors.median_px, 0.1);
  EXPECT_LT(errors.outlier_share, 0.005);
}

TEST(DenseSurfMatcher, FindsNoMoreThanItsReach) {
  MatcherOptions options;
  options.reach = 0.05;  // 24 px, and 36 px that the finer levels add
  int found = 0;
  for (const PixelMatch& match : matchBy(options, movedPair(75, 0)))
    found += std::abs(match.live_px.x() - match.model_px.x() - 79) < 4;
  EXPECT_EQ(found, 0);
}

TEST(DenseSurfMatcher, WhatLiesAtTheRimOfTheSearchIsNoMatch) {
  test::WarpedPair pair = test::makeWarpedPair(0, 200, 150);
  const GrayImage& model = pair.model.gray;
  for (int v = 0; v < model.height_px; ++v)
    for (int u = 0; u < model.width_px; ++u)
      pair.live.gray.at(u, v) = model.at(std::max(u - 10, 0), v);
  MatcherOptions options;
  options.subpixel.method = "none";
  const auto movedAbout10 = [&](double reach) {
    options.reach = reach;
    int found = 0;
    for (const PixelMatch& match : matchBy(options, pair))
      found += std::abs(match.live_px.x() - match.model_px.x() - 10) < 2;
    return found;
  };
  EXPECT_EQ(movedAbout10(0.045), 0);  // 9 px, nearly there
  EXPECT_GT(movedAbout10(0.06), 300);
}

TEST(DenseSurfMatcher, GivesOneMatchPerPlaceByRows) {
  const auto matches = matchBy({}, test::makeWarpedPair(4.0));
  for (std::size_t i = 1; i < matches.size(); ++i) {
    const Vector2f &a = matches[i - 1].model_px, &b = matches[i].model_px;
    EXPECT_TRUE(a.y() < b.y() || (a.y() == b.y() && a.x() < b.x())) << i;
  }
}

TEST(DenseSurfMatcher, RatioTestRefusesAPatternThatRepeats) {
  test::WarpedPair pair = test::makeWarpedPair(0);
  for (int v = 0; v < pair.model.gray.height_px; ++v)
    for (int u = 0; u < pair.model.gray.width_px; ++u)
      pair.model.gray.at(u, v) = pair.live.gray.at(u, v) =
          static_cast<std::uint8_t>(128 + 60 * ((u / 6 + v / 6) % 2));
  // 12 px period, 24 px reach: all positions are similar, except the corners of the image.
  EXPECT_LT(matchBy({}, pair).size(), 20u);
}

class EveryMatcher : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMatcher,
                         testing::Values("dense-surf", "sift", "dis-flow", "surf-off"),
                         [](const auto& one) {
                           std::string name = one.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST_P(EveryMatcher, SaysItsNameAndMatches) {
  const auto matcher = makeFeatureMatcher(methodOf(GetParam()));
  EXPECT_EQ(matcher->name(), GetParam());
  const test::WarpedPair pair = test::makeWarpedPair(1.0);
  const auto errors = test::errorsOf(matcher->match(pair.model, pair.live));
  if (matcher->name() == "surf-off")
    EXPECT_EQ(errors.count, 0u);
  else
    EXPECT_LT(errors.median_px, 0.3) << errors.count;  // SIFT's own places are the worst
}

TEST_P(EveryMatcher, GivesTheSameOnOneThread) {
  const test::WarpedPair pair = test::makeWarpedPair(2.0);
  const auto many = matchBy(methodOf(GetParam()), pair);
  const ThreadLimit one(1);
  EXPECT_TRUE(same(many, matchBy(methodOf(GetParam()), pair)));
}

TEST_P(EveryMatcher, StaysSilentWhereThereIsNothing) {
  const auto matcher = makeFeatureMatcher(methodOf(GetParam()));
  const test::WarpedPair pair = test::makeWarpedPair(1.0);
  const Mask everything(320, 240, 255);
  for (const std::uint8_t gray : {0, 128, 255}) {
    const MatchPicture flat{GrayImage(320, 240, gray), {}};
    const auto found = matcher->match(flat, pair.live);
    for (const PixelMatch& match : found) EXPECT_TRUE(match.live_px.allFinite());
    if (matcher->name() != "dis-flow") {
      EXPECT_TRUE(found.empty());
    }
    EXPECT_TRUE(matcher->match(flat, flat).empty());
  }
  EXPECT_TRUE(matcher->match({pair.model.gray, everything}, pair.live).empty());
  EXPECT_TRUE(matcher->match(pair.model, {pair.live.gray, everything}).empty());
  EXPECT_TRUE(matcher->match({}, {}).empty());
  const MatchPicture tiny{GrayImage(5, 3, 9), {}};
  EXPECT_TRUE(matcher->match(tiny, tiny).empty());
}

TEST_P(EveryMatcher, NeverMatchesWhatIsIgnored) {
  test::WarpedPair pair = test::makeWarpedPair(1.0);
  pair.model.ignore = Mask(320, 240, 0);
  for (int v = 80; v < 180; ++v)
    for (int u = 100; u < 220; ++u) pair.model.ignore.at(u, v) = 1;
  for (const PixelMatch& match : matchBy(methodOf(GetParam()), pair)) {
    const int u = static_cast<int>(std::lround(match.model_px.x()));
    const int v = static_cast<int>(std::lround(match.model_px.y()));
    // Descriptors may reach 10 px into the mask before two fifths of them are ignored; the
    // windows of the refinement may not.
    EXPECT_FALSE(u >= 108 && u < 212 && v >= 88 && v < 172) << u << ", " << v;
  }
}

TEST_P(EveryMatcher, RefusesUnequalShapes) {
  const test::WarpedPair pair = test::makeWarpedPair(0);
  const auto matcher = makeFeatureMatcher(methodOf(GetParam()));
  const MatchPicture other{GrayImage(300, 240, 0), {}};
  EXPECT_THROW(matcher->match(pair.model, other), Error);
  EXPECT_THROW(matcher->match({pair.model.gray, Mask(3, 3, 0)}, pair.live), Error);
  EXPECT_THROW(matcher->match({pair.model.gray, {}, GrayImage(3, 3)}, pair.live), Error);
}

TEST(MatcherOptions, AreCheckedOneByOne) {
  EXPECT_THROW(makeFeatureMatcher(methodOf("orb")), OptionError);
  const auto refused = [](auto change) {
    MatcherOptions options;
    change(options);
    EXPECT_THROW(makeFeatureMatcher(options), OptionError);
  };
  refused([](MatcherOptions& o) { o.reach = 0; });
  refused([](MatcherOptions& o) { o.reach = 1.1; });
  refused([](MatcherOptions& o) { o.subpixel.method = "magic"; });
}

}  // namespace
}  // namespace softscope
