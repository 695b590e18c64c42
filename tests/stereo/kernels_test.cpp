// tests/stereo/kernels_test.cpp: every instruction set gives the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "stereo/images/gradient_image.h"
#include "stereo/kernels/smoothing_formulas.h"
#include "stereo/kernels/stereo_kernels.h"
#include "support/scene.h"

namespace softscope {
namespace {

using Bytes16 = std::vector<std::uint16_t>;
using Floats = std::vector<float>;

Floats randomFloats(std::size_t count, float low, float high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(low, high);
  Floats values(count);
  for (float& x : values) x = uniform(random);
  return values;
}

/// Bytes, so that NaN equals itself and -0 differs from 0.
bool sameBytes(const Floats& a, const Floats& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class EveryInstructionSet : public testing::Test {
 protected:
  void SetUp() override {
    if (list_.count < 2) GTEST_SKIP() << "this processor runs the baseline set alone";
  }
  /// Runs `compute(set)` on every set and expects one result.
  template <class Compute>
  void expectEqual(const Compute& compute) {
    const auto reference = compute(*list_.sets[0]);
    for (int i = 1; i < list_.count; ++i)
      EXPECT_TRUE(sameBytes(reference, compute(*list_.sets[i]))) << list_.sets[i]->name;
  }
  KernelList<StereoKernels> list_ = allStereoKernels();
};

TEST_F(EveryInstructionSet, ChoosesTheFastestThatRuns) {
  EXPECT_EQ(&matchingKernels(), list_.sets[list_.count - 1]->matching);
  EXPECT_EQ(&refinementKernels(), list_.sets[list_.count - 1]->refinement);
  EXPECT_STREQ(list_.sets[0]->name, "baseline");
}

TEST_F(EveryInstructionSet, MatchesTilesAlike) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(50, 0.3, 0.1), 2.0);
  const GradientImage left(scene.left, 0.5, 128), right(scene.right, 0.5, 128);
  std::vector<std::int16_t> prior(kTileWidth * kTileHeight, 8 * 27);
  const Bytes16 candidates = {3, 20, 25, 26, 27, 28, 29, 33, 60};
  const std::vector<std::uint8_t> everywhere = {1, 0, 0, 0, 1, 0, 0, 1, 1};
  expectEqual([&](const StereoKernels& set) {
    Bytes16 disparity(prior.size()), cost(prior.size());
    const DenseTile tile{64,           96, -1, 320, candidates.data(), everywhere.data(), 9,
                         prior.data(), 24, 22, 50,  disparity.data(),  cost.data()};
    set.matching->denseTile(left.view(), right.view(), tile);
    Floats result(disparity.begin(), disparity.end());
    result.insert(result.end(), cost.begin(), cost.end());
    return result;
  });
}

TEST_F(EveryInstructionSet, FindsSupportAlike) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(50, 0.3, 0.1), 2.0);
  const GradientImage left(scene.left, 0.5, 64), right(scene.right, 0.5, 64);
  expectEqual([&](const StereoKernels& set) {
    Bytes16 volume(320 * 64), sums(320 + kSupportScratch), a(320), b(320), c(320), d(320);
    set.matching->supportRow(
        left.view(), right.view(), 100, 320, 0, 64,
        {volume.data(), sums.data(), a.data(), b.data(), c.data(), d.data(), 320});
    Floats result(volume.begin(), volume.end());
    for (const Bytes16* part : {&a, &b, &c, &d})
      result.insert(result.end(), part->begin(), part->end());
    return result;
  });
}

/// `count` rows of `values`, `stride` apart, with 16 values before the first.
std::vector<const float*> rowsOf(const Floats& values, int stride, int count) {
  std::vector<const float*> rows;
  for (int r = 0; r < count; ++r) rows.push_back(values.data() + r * stride + 16);
  return rows;
}

MomentRow momentsIn(Floats& values, int stride) {
  MomentRow moments;
  for (int k = 0; k < kMomentCount; ++k) moments.sums[k] = values.data() + k * stride;
  return moments;
}

TEST_F(EveryInstructionSet, SumsMomentsAlike) {
  const int width = 333, radius = 6, stride = 384;
  const Floats in = randomFloats(static_cast<std::size_t>(stride) * 26, -30, 30, 5);
  const Floats window = randomFloats(13, 0, 1, 6);
  const auto rows = rowsOf(in, stride, 26);
  expectEqual([&](const StereoKernels& set) {
    Floats columns(static_cast<std::size_t>(stride) * kColumnMomentCount), out(stride * 14ul);
    std::vector<float*> column_rows;
    for (int k = 0; k < kColumnMomentCount; ++k)
      column_rows.push_back(columns.data() + k * stride + 16);
    set.refinement->columnMoments(&rows[0], &rows[13], window.data(), radius, width,
                                  column_rows.data());
    set.refinement->rowMoments(column_rows.data(), window.data(), radius, width,
                               momentsIn(out, stride));
    set.refinement->sumRows(rows.data(), window.data(), 13, width, out.data() + 13 * stride);
    return out;
  });
}

TEST_F(EveryInstructionSet, SelectsWindowsAlike) {
  const int stride = 384;
  const Floats in = randomFloats(static_cast<std::size_t>(stride) * 91, 0, 30, 15);
  const auto rows = rowsOf(in, stride, 91);
  const Floats window(13 * kSelectLanes, 0.5f), tolerance(13 * kSelectLanes, 0.5f);
  const std::vector<int> columns = {0, 7, 100, 101, 332};
  SelectedRows selected{};
  selected.disparity = &rows[0];
  selected.information = &rows[13];
  selected.target = &rows[26];
  for (std::size_t m = 0; m < 4; ++m) selected.evidence[m] = &rows[39 + 13 * m];
  selected.window = window.data();
  selected.tolerance = tolerance.data();
  selected.relative = true;
  selected.radius = 6;
  expectEqual([&](const StereoKernels& set) {
    Floats out(static_cast<std::size_t>(stride) * kMomentCount);
    std::vector<unsigned char> mixed(stride, 7);
    set.refinement->markMixed(selected, columns.data(), 5, mixed.data());
    set.refinement->selectedMoments(selected, columns.data(), 5, momentsIn(out, stride));
    EXPECT_EQ(mixed[332], 1);  // half of 0 to 30 lie farther off than half of the centre
    EXPECT_EQ(mixed[331], 7);
    EXPECT_NE(out[12 * stride + 332], 0);  // the last moment of the last column was written
    out.insert(out.end(), mixed.begin(), mixed.end());
    return out;
  });
}

TEST_F(EveryInstructionSet, SolvesPlanesAlike) {
  const int width = 208;
  const Floats sums = randomFloats(static_cast<std::size_t>(width) * kMomentCount, 0.1f, 9, 8);
  Floats before = randomFloats(width, 10, 12, 9);
  before[17] = std::numeric_limits<float>::quiet_NaN();
  for (const float of_disparity : {1.0f, 0.0f})
    expectEqual([&](const StereoKernels& set) {
      Floats copy = sums, out(5 * width);
      const PlaneRow row{momentsIn(copy, width),
                         before.data(),
                         width,
                         of_disparity,
                         50,
                         0.1f,
                         0.2f,
                         70,
                         0.01f,
                         100,
                         1e9f,
                         1.5f,
                         out.data(),
                         out.data() + width,
                         out.data() + 2 * width,
                         out.data() + 3 * width,
                         out.data() + 4 * width};
      set.refinement->solvePlanes(row);
      set.refinement->estimatePlaneErrors(row);
      EXPECT_TRUE(std::isnan(out[17]));
      return out;
    });
}

TEST_F(EveryInstructionSet, ShrinksReliefAlike) {
  constexpr int kWidth = 208;
  const Floats planes = randomFloats(kWidth, 10, 12, 31);
  Floats disparity = randomFloats(kWidth, 10, 12, 32);
  disparity[17] = std::numeric_limits<float>::quiet_NaN();
  const Floats sigma = randomFloats(kWidth, 0.1f, 2, 33);
  const Floats smooth = randomFloats(kWidth, -0.1f, 0.1f, 34);
  expectEqual([&](const StereoKernels& set) {
    Floats shrunk = disparity, shrunk_sigma = sigma, relief_sq(kWidth), noise_sq(kWidth);
    const ReliefRow row{planes.data(), smooth.data(),    shrunk.data(),   shrunk_sigma.data(),
                        kWidth,        relief_sq.data(), noise_sq.data(), 0.01f};
    set.refinement->measureRelief(row);
    EXPECT_EQ(relief_sq[17], 0);
    EXPECT_EQ(noise_sq[17], 0);
    set.refinement->shrinkRelief(row);
    EXPECT_TRUE(std::isnan(shrunk[17]));
    for (const Floats& more : {relief_sq, noise_sq, shrunk_sigma})
      shrunk.insert(shrunk.end(), more.begin(), more.end());
    return shrunk;
  });
}

TEST_F(EveryInstructionSet, SamplesTheRightRowAlike) {
  const int width = 304;
  const Floats left = randomFloats(width, -40, 40, 1), right = randomFloats(width + 8, -40, 40, 2);
  const Floats slow_left = randomFloats(width, 90, 110, 7),
               slow_right = randomFloats(width + 8, 90, 110, 8);
  Floats disparity = randomFloats(width, -3, 40, 3);
  disparity[50] = std::numeric_limits<float>::quiet_NaN();
  for (const float of_disparity : {1.0f, 0.0f})
    expectEqual([&](const StereoKernels& set) {
      Floats out(static_cast<std::size_t>(width) * 6);
      set.refinement->residualRow({left.data(),
                                   right.data() + 3,
                                   slow_left.data(),
                                   slow_right.data() + 3,
                                   {0.5f, -1.5f, 0.01f, 304},
                                   disparity.data(),
                                   width,
                                   {0.2f, 4.0f, 4.0f, 0.1f, of_disparity},
                                   out.data(),
                                   out.data() + width,
                                   out.data() + 2 * width,
                                   out.data() + 3 * width,
                                   out.data() + 4 * width,
                                   out.data() + 5 * width});
      for (int k = 0; k < 6; ++k) EXPECT_EQ(out[k * width + 50], 0);  // no weight where unmatched
      return out;
    });
}

TEST_F(EveryInstructionSet, SmoothsACellAsTheFormulasSay) {
  constexpr int kBegin = 36, kEnd = 43, kRow = 20, kPixels = 64;
  SmoothingCell cell{};
  const Floats numbers = randomFloats(60, 0.1f, 1.5f, 21);
  std::memcpy(&cell, numbers.data(), 44 * sizeof(float));  // all but what is set now
  for (int k = 0; k < 4; ++k) cell.u0[k] = 30.0f + 8 * numbers[44 + static_cast<std::size_t>(k)];
  cell.number = 4;
  cell.size = 8;
  cell.scale = 1.0f / 16;
  Floats disparity = randomFloats(kPixels, 1, 3, 22), sigma = randomFloats(kPixels, 0.05f, 1, 23);
  disparity[38] = std::numeric_limits<float>::quiet_NaN();
  sigma[39] = 0;
  Floats expected = disparity;
  expected.insert(expected.end(), sigma.begin(), sigma.end());
  for (int u = kBegin; u < kEnd; ++u) {
    const std::size_t at = static_cast<std::size_t>(u);
    if (std::isnan(disparity[at]) || !(sigma[at] > 0)) continue;
    const CellPosition position = cellPosition(u, cell.size);
    ASSERT_EQ(position.cell, cell.number);
    float weight[4], variances[4], predictions[4];
    for (int k = 0; k < 4; ++k) {
      float c[6];
      for (int i = 0; i < 6; ++i) c[i] = cell.c[i][k];
      const float x = (static_cast<float>(u) - cell.u0[k]) * cell.scale,
                  y = (static_cast<float>(kRow) - cell.v0[k]) * cell.scale;
      const float predicted = patchValue(c, x, y);
      const float share =
          cell.share_left[k] * (1.0f - position.fraction) + cell.share_right[k] * position.fraction;
      weight[k] =
          patchWeight(share, disparity[at] - predicted, cell.variance[k], sigma[at] * sigma[at]);
      variances[k] = weight[k] * cell.variance[k];
      predictions[k] = weight[k] * predicted;
    }
    const SmoothedPixel drawn = drawToPatches(disparity[at], sigma[at], sumFour(weight),
                                              sumFour(variances), sumFour(predictions));
    EXPECT_NE(drawn.disparity_px, disparity[at]);
    expected[at] = drawn.disparity_px;
    expected[kPixels + at] = drawn.sigma_px;
  }
  for (int i = 0; i < list_.count; ++i) {
    Floats out = disparity;
    out.insert(out.end(), sigma.begin(), sigma.end());
    list_.sets[i]->smoothing->smoothCell(cell, kRow, kBegin, kEnd, out.data(),
                                         out.data() + kPixels);
    EXPECT_TRUE(sameBytes(out, expected)) << list_.sets[i]->name;
  }
}

/// Bytes of four rows and phases, all of them.
struct RowsToMix {
  std::vector<std::uint8_t> rows[4], phase;

  RowsToMix() {
    std::mt19937 random(31);
    for (int i = 0; i < 3 * kRowPhases + 5; ++i) {
      for (auto& row : rows) row.push_back(static_cast<std::uint8_t>(random()));
      phase.push_back(static_cast<std::uint8_t>(i % kRowPhases));
    }
  }

  std::vector<std::uint8_t> mixedBy(const StereoKernels& set) const {
    const std::uint8_t* const in[] = {rows[0].data(), rows[1].data(), rows[2].data(),
                                      rows[3].data()};
    std::vector<std::uint8_t> out(phase.size());
    set.resampling->mixRows(in, phase.data(), static_cast<int>(phase.size()), out.data());
    return out;
  }
};

TEST_F(EveryInstructionSet, MixesRowsAlike) {
  const RowsToMix mix;
  expectEqual([&](const StereoKernels& set) {
    const auto out = mix.mixedBy(set);
    return Floats(out.begin(), out.end());
  });
}

TEST(RowResampling, MixesRowsAsCatmullAndRomDo) {
  const RowsToMix mix;
  const auto out = mix.mixedBy(*allStereoKernels().sets[0]);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = static_cast<double>(mix.phase[i]) / kRowPhases;
    const double a = mix.rows[0][i], b = mix.rows[1][i], c = mix.rows[2][i], d = mix.rows[3][i];
    const double exact =
        b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d) + t * t * (3 * (b - c) + d - a));
    EXPECT_NEAR(out[i], std::clamp(exact, 0.0, 255.0), 0.6) << i;  // rounding, and of weights
  }
}

TEST_F(EveryInstructionSet, SolvesNormalsAlike) {
  const int width = 200, stride = 256;
  Floats depth = randomFloats(static_cast<std::size_t>(stride) * 7, 48, 52, 21);
  depth[3 * stride + 40] = std::numeric_limits<float>::quiet_NaN();
  const Floats sums = randomFloats(static_cast<std::size_t>(stride) * kMomentCount, 0.1f, 49, 22);
  expectEqual([&](const StereoKernels& set) {
    Floats out(stride * 26ul, std::numeric_limits<float>::quiet_NaN()), copy = sums;
    for (int y = 0; y < 7; ++y)
      set.normal->invertRow({depth.data() + y * stride, width, out.data() + y * stride + 16,
                             out.data() + (7 + y) * stride, out.data() + (14 + y) * stride});
    const auto rows = rowsOf(out, stride, 7);
    std::vector<unsigned char> mixed(stride);
    set.normal->findMixed(rows.data(), 3, width, 0.05f, out.data() + 21 * stride + 16,
                          out.data() + 22 * stride + 16, mixed.data());
    set.normal->solveNormals(
        {momentsIn(copy, stride),
         rows[3],
         width,
         12,
         560,
         560,
         100,
         -7,
         {out.data() + 23 * stride, out.data() + 24 * stride, out.data() + 25 * stride}});
    EXPECT_TRUE(std::isnan(out[23 * stride + 40]));
    out.insert(out.end(), mixed.begin(), mixed.end());
    return out;
  });
}

}  // namespace
}  // namespace softscope
