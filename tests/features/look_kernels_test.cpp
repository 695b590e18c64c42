// tests/features/look_kernels_test.cpp: instruction sets agree to the byte, and with plain sums.
#include "features/look_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "core/image.h"

namespace softscope {
namespace {

constexpr int kSide = kLookSidePx, kHalf = kLookHalfPx;

double brightnessAt(double u, double v) {
  return 120 + 30 * std::sin(0.5 * u + 0.2 * v) + 25 * std::cos(0.45 * v - 0.17 * u) + 0.4 * u;
}

/// The texture around (30, 30), and the look at its middle.
struct LookScene {
  GrayImage image{60, 60};
  Mask ignore{60, 60};
  std::vector<std::uint8_t> gray = std::vector<std::uint8_t>(kLookValues, 0);
  std::vector<std::uint8_t> ignored = std::vector<std::uint8_t>(kLookValues, 1);

  LookScene() {
    for (int v = 0; v < 60; ++v)
      for (int u = 0; u < 60; ++u)
        image.at(u, v) = static_cast<std::uint8_t>(std::lround(brightnessAt(u, v)));
    for (int i = 0; i < kLookPixels; ++i) {
      gray[static_cast<std::size_t>(i)] = image.at(30 - kHalf + i % kSide, 30 - kHalf + i / kSide);
      ignored[static_cast<std::size_t>(i)] = i % 29 == 3;
    }
    ignore.at(33, 27) = 1;
  }
  LookImage view() const { return {image.values.data(), 60, 60}; }
  LookImage mask() const { return {ignore.values.data(), 60, 60}; }
};

const LookPlaces kInPlace{30, 30, 0, 0, {1, 0, 0, 1}};
const LookPlaces kDistorted{29, 31, 0.3f, 0.8f, {1.05f, 0.04f, -0.03f, 0.97f}};

/// What a set computes of the scene.
struct KernelResults {
  LookTemplate look{};
  bool sampled = false;
  LookSamples samples{};
  LookPlane difference{};
  double noise[kMapUnknowns][kMapUnknowns];
  double boxes[2];
};

constexpr float kPlaceTerms[2][kMapUnknowns] = {{1, 0.1f, 0.02f, 0, 0, 0.01f},
                                                {0.2f, 0.8f, 0, 0.03f, 0.01f, 0}};

KernelResults resultsOf(const LookKernels& kernels, const LookPlaces& places) {
  const LookScene scene;
  KernelResults found;
  kernels.countPixels(scene.ignored.data(), scene.mask(), places, 5, &found.look);
  kernels.describeLook(scene.gray.data(), &found.look);
  found.sampled = kernels.sampleLook(found.look, scene.view(), places, &found.samples);
  kernels.differenceOf(found.look, found.samples, &found.difference);
  kernels.normalOfNoise(found.look, found.difference, found.noise);
  kernels.boxSums(found.look, found.difference, kPlaceTerms, found.boxes);
  return found;
}

template <class Value>
bool sameBytes(const Value& a, const Value& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(LookKernels, GiveTheSameBytesOnEveryInstructionSet) {
  const auto list = allLookKernels();
  const KernelResults first = resultsOf(*list.sets[0], kDistorted);
  ASSERT_TRUE(first.sampled);
  for (int k = 1; k < list.count; ++k) {
    const KernelResults other = resultsOf(*list.sets[k], kDistorted);
    SCOPED_TRACE(list.sets[k]->name);
    EXPECT_TRUE(sameBytes(first.look.weights, other.look.weights));
    EXPECT_TRUE(sameBytes(first.look.first, other.look.first));
    EXPECT_TRUE(sameBytes(first.look.changes, other.look.changes));
    EXPECT_TRUE(sameBytes(first.look.normal, other.look.normal));
    EXPECT_TRUE(sameBytes(first.samples.values, other.samples.values));
    EXPECT_TRUE(sameBytes(first.samples.with_changes, other.samples.with_changes));
    EXPECT_EQ(first.samples.deviation, other.samples.deviation);
    EXPECT_TRUE(sameBytes(first.noise, other.noise));
    EXPECT_TRUE(sameBytes(first.boxes, other.boxes));
  }
}

TEST(LookKernels, CountEveryPixelOnce) {
  const KernelResults found = resultsOf(lookKernels(), kInPlace);
  int expected = 0;
  for (int i = 0; i < kLookPixels; ++i) {
    const int u = 30 - kHalf + i % kSide, v = 30 - kHalf + i / kSide;
    const bool masked = (u == 32 || u == 33) && (v == 26 || v == 27);  // reached by the bilinear
    const bool counted = i % 29 != 3 && !masked;
    EXPECT_EQ(found.look.weights.values[i], counted ? 1 : 0) << i;
    expected += counted;
  }
  EXPECT_EQ(found.look.count, expected);
  for (int i = kLookPixels; i < kLookValues; ++i) EXPECT_EQ(found.look.weights.values[i], 0) << i;
}

// The window itself: no difference, whatever the light.
TEST(LookKernels, FindNoDifferenceFromTheLookItself) {
  const KernelResults found = resultsOf(lookKernels(), kInPlace);
  ASSERT_TRUE(found.sampled);
  EXPECT_NEAR(found.samples.deviation, found.look.contrast, 1e-4 * found.look.contrast);
  EXPECT_NEAR(found.samples.with_first, found.samples.deviation * found.look.count,
              1e-3 * found.look.count);
  for (const float value : found.difference.values) EXPECT_NEAR(value, 0, 1e-4);
}

/// Sum of first and of changes over the counted pixels, times 1, x and y.
TEST(LookKernels, LeaveNoShading) {
  const KernelResults found = resultsOf(lookKernels(), kDistorted);
  const auto expectNone = [](const LookPlane& plane, const char* what) {
    double constant = 0, across = 0, down = 0;
    for (int i = 0; i < kLookPixels; ++i) {
      constant += plane.values[i];
      across += plane.values[i] * (i % kSide - kHalf);
      down += plane.values[i] * (i / kSide - kHalf);
    }
    EXPECT_NEAR(constant, 0, 0.01) << what;
    EXPECT_NEAR(across, 0, 0.1) << what;
    EXPECT_NEAR(down, 0, 0.1) << what;
  };
  expectNone(found.look.first, "first");
  for (const LookPlane& change : found.look.changes) expectNone(change, "change");
}

TEST(LookKernels, SumBoxesAsPlainLoopsDo) {
  const KernelResults found = resultsOf(lookKernels(), kDistorted);
  double sums[2] = {0, 0};
  for (int y = -kBoxPx + 1; y < kSide; ++y)
    for (int x = -kBoxPx + 1; x < kSide; ++x) {
      double box[2] = {0, 0};
      for (int v = std::max(y, 0); v < std::min(y + kBoxPx, kSide); ++v)
        for (int u = std::max(x, 0); u < std::min(x + kBoxPx, kSide); ++u)
          for (int axis = 0; axis < 2; ++axis)
            for (int k = 0; k < kMapUnknowns; ++k)
              box[axis] += static_cast<double>(found.difference.values[v * kSide + u]) *
                           found.look.changes[k].values[v * kSide + u] * kPlaceTerms[axis][k];
      sums[0] += box[0] * box[0];
      sums[1] += box[1] * box[1];
    }
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(found.boxes[k], sums[k], 1e-4 * (sums[0] + sums[1])) << k;
}

TEST(LookKernels, SampleNothingOutside) {
  EXPECT_FALSE(resultsOf(lookKernels(), {-1, 30, 0, 0, {1, 0, 0, 1}}).sampled);
  // Pixels at the margin of the count leave the image once the window has moved by more.
  const LookScene scene;
  LookTemplate look{};
  lookKernels().countPixels(scene.ignored.data(), {nullptr, 60, 60}, {15, 30, 0, 0, {1, 0, 0, 1}},
                            5, &look);
  lookKernels().describeLook(scene.gray.data(), &look);
  LookSamples samples{};
  EXPECT_TRUE(lookKernels().sampleLook(look, scene.view(), {10, 30, 0, 0, {1, 0, 0, 1}}, &samples));
  EXPECT_FALSE(lookKernels().sampleLook(look, scene.view(), {9, 30, 0, 0, {1, 0, 0, 1}}, &samples));
}

}  // namespace
}  // namespace softscope
