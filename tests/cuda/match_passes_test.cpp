// tests/cuda/match_passes_test.cpp: the kernels of matching, run on the host in shuffled orders,
// give the CPU's bytes.
#include <gtest/gtest.h>

#include "features/dense_surf.h"
#include "host_match.h"
#include "match_cases.h"

namespace softscope {
namespace {

class MatchPasses : public testing::TestWithParam<test::MatchCase> {
 protected:
  MatchPasses()
      : pair_(test::pairOf(GetParam())),
        host_(GetParam().options, GetParam().width, GetParam().height, 1) {}

  test::WarpedPair pair_;
  test::HostMatch host_;
};

TEST_P(MatchPasses, GiveTheCpusMatches) {
  const std::vector<PixelMatch> expected =
      makeFeatureMatcher(GetParam().options)->match(pair_.model, pair_.live);
  ASSERT_GT(expected.size(), 100U);
  const std::vector<PixelMatch> found = host_.match(pair_.model, pair_.live);
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_EQ(test::differingMatches(found, expected), 0);
}

TEST_P(MatchPasses, GiveTheCpusDescriptors) {
  host_.match(pair_.model, pair_.live);
  const cuda::MatchScale& full = host_.layout().levels.front();
  for (int image = 0; image < 2; ++image) {
    Mask ignore(full.width, full.height);
    std::copy_n(full.ignore[image].data, ignore.size(), ignore.values.data());
    const DenseDescriptors expected = denseSurf(image == 0 ? pair_.model.gray : pair_.live.gray,
                                                ignore, GetParam().options.dense_surf);
    const cuda::SurfNodes& nodes = full.nodes[image];
    ASSERT_EQ(nodes.columns, expected.columns());
    ASSERT_EQ(nodes.rows, expected.rows());
    EXPECT_EQ(std::memcmp(nodes.descriptors, expected.bytes.data(), expected.bytes.size()), 0);
    EXPECT_EQ(std::memcmp(nodes.valid, expected.valid.values.data(), expected.valid.size()), 0);
  }
}

TEST_P(MatchPasses, GiveTheSameInAnyOrderOfThreads) {
  const std::vector<PixelMatch> expected = host_.match(pair_.model, pair_.live);
  test::HostMatch other(GetParam().options, GetParam().width, GetParam().height, 77);
  other.match(pair_.live, pair_.model);  // nothing is left of the frame before
  EXPECT_EQ(test::differingMatches(other.match(pair_.model, pair_.live), expected), 0);
}

INSTANTIATE_TEST_SUITE_P(Cuda, MatchPasses, testing::ValuesIn(test::matchCases()),
                         [](const auto& each) { return each.param.name; });

TEST(MatchPassesEdge, ImagesWithoutTextureOrSmallerThanADescriptorHaveNoMatches) {
  for (const int side : {120, 20}) {
    const MatchPicture flat{GrayImage(side, side, 100), {}};
    EXPECT_TRUE(test::HostMatch(MatcherOptions(), side, side, 1).match(flat, flat).empty());
  }
}

TEST(MatchPassesEdge, MethodsWithoutKernelsAreRefused) {
  MatcherOptions options;
  options.method = "sift";
  EXPECT_THROW(cuda::requireMatchLimits(options, 640, 480), OptionError);
}

}  // namespace
}  // namespace softscope
