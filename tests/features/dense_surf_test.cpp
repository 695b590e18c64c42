// tests/features/dense_surf_test.cpp: the sharing of sums changes nothing but the time.
#include "features/dense_surf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "core/parallel.h"
#include "features/kernels.h"
#include "features/warped_pair.h"

namespace softscope {
namespace {

/// A descriptor straight from its definition: no integral image, nothing shared.
std::array<double, 64> byDefinition(const GrayImage& image, int centre_u, int centre_v,
                                    const DenseSurfOptions& options) {
  const int h = options.kWaveletPx / 2, cell = options.cell_px;
  const int left = centre_u + 1 - 2 * cell, top = centre_v + 1 - 2 * cell;
  std::array<double, 64> sums{};
  for (int y = 0; y < 4 * cell; ++y)
    for (int x = 0; x < 4 * cell; ++x) {
      double du = 0, dv = 0;
      for (int b = -h; b < h; ++b)
        for (int a = -h; a < h; ++a) {
          const double gray = image.at(left + x + a, top + y + b);
          du += a < 0 ? -gray : gray;
          dv += b < 0 ? -gray : gray;
        }
      double* to = &sums[static_cast<std::size_t>(16 * (y / cell) + 4 * (x / cell))];
      to[0] += du;
      to[1] += std::abs(du);
      to[2] += dv;
      to[3] += std::abs(dv);
    }
  double length = 0;
  for (const double s : sums) length += s * s;
  for (double& s : sums) s /= std::sqrt(length);
  return sums;
}

TEST(DenseSurf, IsWhatItsDefinitionSays) {
  const GrayImage image = test::makeWarpedPair(2.0).model.gray;
  for (const int cell_px : {3, 6, 9}) {
    DenseSurfOptions options;
    options.cell_px = cell_px;
    const DenseDescriptors found = denseSurf(image, {}, options);
    for (const auto& [c, r] : {std::pair{5, 7}, std::pair{40, 30}, std::pair{60, 50}}) {
      const auto truth =
          byDefinition(image, found.first_px + 3 * c, found.first_px + 3 * r, options);
      for (int k = 0; k < 64; ++k) {
        const double value = 128 + kDescriptorUnit * truth[static_cast<std::size_t>(k)];
        EXPECT_NEAR(found.descriptor(c, r)[k], std::min(value, 255.0), 0.51);  // rounding
      }
    }
  }
}

TEST(DenseSurf, GainAndOffsetChangeNothing) {
  const GrayImage dim = test::makeWarpedPair(0).model.gray;
  GrayImage bright = dim;
  for (std::uint8_t& gray : bright.values) gray = static_cast<std::uint8_t>(gray / 2 * 2 / 2 + 60);
  GrayImage half = dim;
  for (std::uint8_t& gray : half.values) gray = static_cast<std::uint8_t>(gray / 2);
  EXPECT_EQ(denseSurf(bright, {}, {}).bytes, denseSurf(half, {}, {}).bytes);
}

TEST(DenseSurf, CoversThePictureEveryThirdPixel) {
  const DenseDescriptors found = denseSurf(GrayImage(640, 480, 7), {}, {});
  EXPECT_EQ(found.columns(), 213 - 8 + 1);  // 213 squares of 3 px, a descriptor spans 8
  EXPECT_EQ(found.rows(), 160 - 8 + 1);
  EXPECT_EQ(found.bytes.size(), 64u * found.valid.size());
  for (const std::uint8_t valid : found.valid.values) EXPECT_EQ(valid, 0);  // nothing to see
}

TEST(DenseSurf, IgnoredPixelsNeitherCountNorMakeEdges) {
  test::WarpedPair pair = test::makeWarpedPair(0);
  Mask ignore(320, 240, 0);
  for (int v = 0; v < 240; ++v)
    for (int u = 156; u < 164; ++u) ignore.at(u, v) = 1;
  const DenseDescriptors clean = denseSurf(pair.model.gray, ignore, {});
  for (int v = 0; v < 240; ++v)
    for (int u = 156; u < 164; ++u) pair.model.gray.at(u, v) = 255;
  EXPECT_EQ(denseSurf(pair.model.gray, ignore, {}).bytes, clean.bytes);
  const int column = (160 - clean.first_px) / 3;
  EXPECT_EQ(clean.valid.at(column, 20), 0);  // 11 of its 24 columns of wavelets touch the stripe
  EXPECT_EQ(clean.valid.at(column + 8, 20), 1);
}

TEST(DenseSurf, GivesTheSameBytesOnOneThread) {
  const GrayImage image = test::makeWarpedPair(2.0).model.gray;
  const DenseDescriptors many = denseSurf(image, {}, {});
  const ThreadLimit one(1);
  EXPECT_EQ(denseSurf(image, {}, {}).bytes, many.bytes);
}

TEST(DenseSurf, RefusesAMaskOfAnotherShape) {
  EXPECT_THROW(denseSurf(GrayImage(100, 100), Mask(99, 100), {}), Error);
  EXPECT_TRUE(denseSurf(GrayImage(20, 20), {}, {}).valid.empty());  // smaller than a descriptor
}

TEST(FeatureKernels, EveryInstructionSetGivesTheSameBytes) {
  const auto list = allFeatureKernels();
  const GrayImage image = test::makeWarpedPair(2.0).model.gray;
  std::vector<float> cells(4096), plane(4096);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    cells[k] = static_cast<float>(image.values[k]) - 100;
    plane[k] = static_cast<float>(image.values[3 * k]);
  }
  const float* rows[] = {cells.data(), cells.data() + 300, cells.data() + 700, cells.data() + 900};
  const WindowTemplate window{cells.data(), cells.data() + 240, cells.data() + 480,
                              cells.data() + 720, 15};
  std::uint8_t first[64], bytes[64];
  std::uint16_t first_distances[40], distances[40];
  for (int s = 0; s < list.count; ++s) {
    const FeatureKernels& set = *list.sets[s];
    const float length = set.describe(rows, 8, s == 0 ? first : bytes);
    EXPECT_EQ(length, list.sets[0]->describe(rows, 8, first));
    set.descriptorDistances(first, image.values.data(), 40, s == 0 ? first_distances : distances);
    const WindowSums sums = set.windows->windowSums(window, plane.data(), 40, 0.3f, 0.7f);
    const WindowSums expected =
        list.sets[0]->windows->windowSums(window, plane.data(), 40, 0.3f, 0.7f);
    EXPECT_EQ(sums.along_u, expected.along_u);
    EXPECT_EQ(sums.along_contrast, expected.along_contrast);
    EXPECT_EQ(sums.square, expected.square);
    if (s == 0) continue;
    EXPECT_TRUE(std::equal(first, first + 64, bytes)) << set.instruction_set;
    EXPECT_TRUE(std::equal(first_distances, first_distances + 40, distances));
  }
}

}  // namespace
}  // namespace softscope
