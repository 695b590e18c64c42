// tests/core/value_of_rank_test.cpp: order statistics are those of sorting.
#include "core/value_of_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/parallel.h"

namespace softscope {
namespace {

TEST(ValueOfRank, IsTheSortedOne) {
  std::mt19937 random(3);
  std::normal_distribution<float> values(0, 2);
  for (const int most : {1, 40, 900}) {
    std::vector<std::vector<float>> parts(70);
    std::vector<float> sorted;
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (int i = 0; i < static_cast<int>(k * 7) % most + (k == 5); ++i) {
        parts[k].push_back(i % 9 == 0 ? 0.25f : values(random));  // some are equal
        sorted.push_back(std::abs(parts[k].back()));
      }
    std::sort(sorted.begin(), sorted.end());
    for (const std::size_t rank : {std::size_t{0}, sorted.size() / 2, sorted.size() - 1}) {
      EXPECT_EQ(absoluteOfRank(parts, rank), sorted[rank]);
      const ThreadLimit one(1);
      EXPECT_EQ(absoluteOfRank(parts, rank), sorted[rank]);
    }
  }
}

TEST(ValueOfRank, TakesZeroAndInfinity) {
  const std::vector<std::vector<float>> parts{{INFINITY, 0}, {}, {-INFINITY, 1e-40f}};
  EXPECT_EQ(absoluteOfRank(parts, 0), 0);
  EXPECT_EQ(absoluteOfRank(parts, 1), 1e-40f);
  EXPECT_EQ(absoluteOfRank(parts, 3), INFINITY);
}

TEST(ValueOfRank, MedianIsTheUpperOfTwo) {
  const auto medianOf = [](const std::vector<float>& values) {
    SizeCounts first, second, all;
    for (std::size_t i = 0; i < values.size(); ++i) (i % 2 == 0 ? first : second).add(values[i]);
    all.add(first);
    all.add(second);
    EXPECT_EQ(all.total(), values.size());
    const SizeCounts::Place place = all.placeOfMedian();
    std::vector<float> in_bin;
    for (const float value : values)
      if (SizeCounts::binOf(value) == place.bin) in_bin.push_back(std::abs(value));
    return SizeCounts::valueAt(place, &in_bin);
  };
  EXPECT_EQ(medianOf({-4, 1, 2, 3}), 3);
  EXPECT_EQ(medianOf({-4, 1, 2}), 2);
  EXPECT_EQ(medianOf({1.0001F, 1.0003F, -1.0002F}), 1.0002F) << "in one bin";
}

}  // namespace
}  // namespace softscope
