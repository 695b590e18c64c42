// tests/features/kernels_test.cpp: every instruction set gives what the plain loops give, to the
// last bit.
#include "features/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "features/match_formulas.h"
#include "features/subpixel_formulas.h"

namespace softscope {
namespace {

/// The same numbers everywhere.
class Numbers {
 public:
  int below(int end) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(end));
  }

 private:
  std::uint64_t state_ = 1;
};

int plainDistance(const std::uint8_t* one, const std::uint8_t* other) {
  int sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) sum += std::abs(one[k] - other[k]);
  return sum;
}

/// A grid of descriptors, some of them equal and some not valid.
struct Grid {
  static constexpr int kColumns = 40, kRows = 12;
  std::vector<std::uint8_t> bytes, valid;

  explicit Grid(int kinds) : bytes(kDescriptorSize * kColumns * kRows), valid(kColumns * kRows) {
    Numbers numbers;
    for (std::size_t node = 0; node < valid.size(); ++node) {
      const int kind = numbers.below(kinds);
      for (std::size_t k = 0; k < kDescriptorSize; ++k)
        bytes[kDescriptorSize * node + k] =
            static_cast<std::uint8_t>(kind * 37 + static_cast<int>(k) * (kind % 5));
      valid[node] = numbers.below(4) > 0;
    }
  }
  std::size_t node(int column, int row) const {
    return static_cast<std::size_t>(row * kColumns + column);
  }
};

TEST(FeatureKernels, SearchAWindowAsPlainLoopsDo) {
  const auto list = allFeatureKernels();
  for (const int kinds : {2, 6, 200})
    for (int columns = 1; columns <= 35; ++columns)
      for (const int rows : {1, 4, 9}) {
        const Grid grid(kinds);
        const int c0 = 3, r0 = 2, reach = 2;
        const std::uint8_t* one = grid.bytes.data() + kDescriptorSize * grid.node(17, 5);
        NearestNode nearest{kNoDistance, 0, 0};
        std::vector<int> plain;
        for (int r = 0; r < rows; ++r)
          for (int c = 0; c < columns; ++c) {
            const std::size_t node = grid.node(c0 + c, r0 + r);
            plain.push_back(grid.valid[node] == 0
                                ? kNoDistance
                                : plainDistance(one, &grid.bytes[kDescriptorSize * node]));
            if (plain.back() < nearest.distance) nearest = {plain.back(), c, r};
          }
        int elsewhere = kNoDistance;
        for (int r = 0; r < rows; ++r)
          for (int c = 0; c < columns; ++c)
            if (std::abs(r - nearest.row) > reach || std::abs(c - nearest.column) > reach)
              elsewhere = std::min(elsewhere, plain[static_cast<std::size_t>(r * columns + c)]);

        const int stride = (columns + kDistanceLanes - 1) / kDistanceLanes * kDistanceLanes;
        std::vector<std::uint16_t> values(static_cast<std::size_t>(stride * rows), 7);
        for (int s = 0; s < list.count; ++s) {
          const FeatureKernels& set = *list.sets[s];
          const NearestNode found = set.searchWindow(
              one,
              {grid.bytes.data() + kDescriptorSize * grid.node(c0, r0),
               grid.valid.data() + grid.node(c0, r0), Grid::kColumns, columns, rows},
              {values.data(), stride});
          ASSERT_EQ(found.distance, nearest.distance) << set.instruction_set;
          ASSERT_EQ(found.column, nearest.column) << set.instruction_set;
          ASSERT_EQ(found.row, nearest.row) << set.instruction_set;
          for (int r = 0; r < rows; ++r)
            for (int c = 0; c < stride; ++c)
              ASSERT_EQ(
                  values[static_cast<std::size_t>(r * stride + c)],
                  c < columns ? plain[static_cast<std::size_t>(r * columns + c)] : kNoDistance);
          ASSERT_EQ(set.secondBestDistance({values.data(), stride}, rows, found, reach), elsewhere);
        }
      }
}

TEST(FeatureKernels, CountNeighboursAsPlainLoopsDo) {
  constexpr int kMatches = 45;
  const ConsistencyRules rules = consistencyRules(ConsistencyOptions());
  Numbers numbers;
  std::array<std::vector<float>, 4> places;
  for (int i = 0; i < kMatches + 8; ++i)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      places[axis].push_back(0.125f * static_cast<float>(numbers.below(240)));
      places[axis + 2].push_back(places[axis].back() +
                                 0.125f * static_cast<float>(numbers.below(40)));
    }
  const auto list = allFeatureKernels();
  for (int count = 0; count <= kMatches; ++count) {
    NeighbourCounts plain{0, 0};
    const auto apart = [&](std::size_t axis, int i) {
      return places[axis][static_cast<std::size_t>(i)] - places[axis][10];
    };
    for (int i = 0; i < count; ++i) {
      if (!areNeighbours(apart(0, i), apart(1, i), rules)) continue;
      ++plain.others;
      plain.agreeing += moveConsistently(apart(0, i), apart(1, i), apart(2, i), apart(3, i), rules);
    }
    for (int s = 0; s < list.count; ++s) {
      const NeighbourCounts found = list.sets[s]->countNeighbours(
          {places[0].data(), places[1].data(), places[2].data(), places[3].data()}, count,
          {&places[0][10], &places[1][10], &places[2][10], &places[3][10]}, rules);
      EXPECT_EQ(found.others, plain.others) << list.sets[s]->instruction_set;
      EXPECT_EQ(found.agreeing, plain.agreeing) << list.sets[s]->instruction_set;
    }
    if (count == kMatches) EXPECT_TRUE(plain.agreeing > 3 && plain.agreeing < plain.others);
  }
}

constexpr int kRows = kLargestWindow, kStride = 40;
using Window = std::array<float, kRows * kWindowLanes>;

/// One window by plain loops, in the order that subpixel_formulas.h names.
struct PlainTemplate {
  Window steepest_u{}, steepest_v{}, contrast{};
  WindowMoments moments{};
  WindowMatrix information{};

  PlainTemplate(const float* corner, const Window& weight) {
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kRows; ++x) {
        const float* at = corner + y * kStride + x;
        const std::size_t k = static_cast<std::size_t>(y * kWindowLanes + x);
        contrast[k] = *at;
        steepest_u[k] = 0.5f * (at[1] - at[-1]);
        steepest_v[k] = 0.5f * (at[kStride] - at[-kStride]);
        moments.mean += weight[k] * contrast[k];
        moments.gradient_u += weight[k] * steepest_u[k];
        moments.gradient_v += weight[k] * steepest_v[k];
      }
    WindowMoments& m = moments;
    for (std::size_t k = 0; k < weight.size(); ++k) {
      const float t = contrast[k] - m.mean;
      m.square += weight[k] * t * t;
      m.along_u += weight[k] * t * (steepest_u[k] - m.gradient_u);
      m.along_v += weight[k] * t * (steepest_v[k] - m.gradient_v);
    }
    for (std::size_t k = 0; k < weight.size(); ++k) {
      const float t = contrast[k] - m.mean, w = weight[k];
      const float u = projectedGradient(steepest_u[k], m.gradient_u, t, m.along_u, m.square),
                  v = projectedGradient(steepest_v[k], m.gradient_v, t, m.along_v, m.square);
      information.uu += w * u * u;
      information.uv += w * u * v;
      information.vu += w * v * u;
      information.vv += w * v * v;
      steepest_u[k] = w * u;
      steepest_v[k] = w * v;
      contrast[k] = w * t;
    }
  }
};

TEST(FeatureKernels, MakeTemplatesAsPlainLoopsDo) {
  Numbers numbers;
  std::vector<float> image(kStride * kStride);
  for (float& gray : image) gray = 0.0625f * static_cast<float>(numbers.below(4000));
  std::array<Window, kTemplateLanes> weights{};
  TemplateWindows windows{};
  windows.stride = kStride;
  windows.rows = kRows;
  for (std::size_t k = 0; k < kTemplateLanes; ++k) {
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kRows; ++x)
        weights[k][static_cast<std::size_t>(y * kWindowLanes + x)] =
            static_cast<float>(numbers.below(3)) / 225;
    windows.corner[k] = image.data() + (1 + k) * kStride + 1 + 2 * k;
    windows.weight[k] = weights[k].data();
  }
  const auto list = allFeatureKernels();
  for (int s = 0; s < list.count; ++s) {
    std::array<Window, kTemplateLanes> steepest_u, steepest_v, contrast;
    TemplateResults results{};
    for (std::size_t k = 0; k < kTemplateLanes; ++k) {
      results.steepest_u[k] = steepest_u[k].data();
      results.steepest_v[k] = steepest_v[k].data();
      results.contrast[k] = contrast[k].data();
    }
    list.sets[s]->windows->windowTemplates(windows, &results);
    for (std::size_t k = 0; k < kTemplateLanes; ++k) {
      const PlainTemplate plain(windows.corner[k], weights[k]);
      ASSERT_GT(plain.moments.square, 0);
      EXPECT_EQ(results.contrast_sq[k], plain.moments.square) << list.sets[s]->instruction_set;
      EXPECT_EQ(results.uu[k], plain.information.uu);
      EXPECT_EQ(results.uv[k], plain.information.uv);
      EXPECT_EQ(results.vu[k], plain.information.vu);
      EXPECT_EQ(results.vv[k], plain.information.vv);
      EXPECT_EQ(steepest_u[k], plain.steepest_u);
      EXPECT_EQ(steepest_v[k], plain.steepest_v);
      EXPECT_EQ(contrast[k], plain.contrast);
    }
  }
}

}  // namespace
}  // namespace softscope
