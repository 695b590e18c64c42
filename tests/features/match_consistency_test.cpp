// tests/features/match_consistency_test.cpp: neighbours move alike, or stretch; mistakes don't.
#include "features/match_consistency.h"

#include <gtest/gtest.h>

#include <random>

namespace softscope {
namespace {

/// One match every 6 pixels; live = model, stretched about (120, 90), and shifted.
std::vector<PixelMatch> stretchedGrid(float stretch) {
  std::vector<PixelMatch> matches;
  for (int v = 6; v < 180; v += 6)
    for (int u = 6; u < 240; u += 6) {
      const Eigen::Vector2f model(static_cast<float>(u), static_cast<float>(v));
      const Eigen::Vector2f off = (1 + stretch) * (model - Eigen::Vector2f(120, 90));
      matches.push_back({model, Eigen::Vector2f(127, 85) + off, 0.1f, 0.9f});
    }
  return matches;
}

TEST(MatchConsistency, KeepsWhatMovesAsOne) {
  const std::vector<PixelMatch> matches = stretchedGrid(0);
  EXPECT_EQ(keepConsistent(matches, {}).size(), matches.size());
}

// An instrument that pushes 2.5 mm within 10 mm stretches the picture by about this much.
TEST(MatchConsistency, KeepsTissueThatStretches) {
  const std::vector<PixelMatch> matches = stretchedGrid(0.18f);
  EXPECT_EQ(keepConsistent(matches, {}).size(), matches.size());
  ConsistencyOptions stiff;
  stiff.max_strain = 0;
  EXPECT_LT(keepConsistent(matches, stiff).size(), matches.size() / 4);
}

// A third of the matches is anywhere in the search window: by chance, two pixels and a fifth of
// the distance agree with few of the neighbours, never with two in five.
TEST(MatchConsistency, DropsMistakes) {
  std::vector<PixelMatch> matches = stretchedGrid(0.05f);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-24, 24);
  std::vector<bool> wrong(matches.size(), false);
  for (std::size_t i = 0; i < matches.size(); i += 3) {
    const Eigen::Vector2f shift(anywhere(random), anywhere(random));
    wrong[i] = (shift - (matches[i].live_px - matches[i].model_px)).norm() > 8;
    if (wrong[i]) matches[i].live_px = matches[i].model_px + shift;
  }
  int kept_wrong = 0, kept_right = 0, all_wrong = 0;
  for (const PixelMatch& match : keepConsistent(matches, {})) {
    const auto at = std::find_if(matches.begin(), matches.end(), [&](const PixelMatch& other) {
      return other.model_px == match.model_px;
    });
    (wrong[static_cast<std::size_t>(at - matches.begin())] ? kept_wrong : kept_right) += 1;
  }
  for (const bool w : wrong) all_wrong += w;
  EXPECT_GT(all_wrong, 200);
  EXPECT_LE(kept_wrong, all_wrong / 50);
  EXPECT_GE(kept_right, static_cast<int>(matches.size()) - all_wrong - 10);
}

}  // namespace
}  // namespace softscope
