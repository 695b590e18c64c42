// src/core/value_of_rank.h: parallel order statistics of large lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace softscope {

/// Absolute values counted by size. Exact order statistics in two passes over the
/// values: the first counts all, the second collects those of the bin that is asked for.
class SizeCounts {
 public:
  SizeCounts();
  /// The bits of a positive float have the order of its value: the upper ones select the bin.
  static std::uint32_t binOf(float value);
  void add(float value) { ++counts_[binOf(value)]; }
  void add(const SizeCounts& others);
  std::size_t total() const;

  struct Place {
    std::uint32_t bin = 0;
    std::size_t rank = 0;  // within the bin
  };
  /// Of the value of that rank (0: smallest), which is below total().
  Place placeOf(std::size_t rank) const;
  /// Of the upper of the two middle values for an even count.
  Place placeOfMedian() const { return placeOf(total() / 2); }
  /// Its value, from the absolute values of its bin in any order.
  static float valueAt(const Place& place, std::vector<float>* in_bin);

 private:
  std::vector<std::uint32_t> counts_;
};

/// Value of that rank (0: smallest) among the absolute values
/// of all parts; exact. Requires a rank below their count.
float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank);

}  // namespace softscope
