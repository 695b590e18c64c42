#include "core/value_of_rank.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kPartsPerTask = 32;

/// The bits of a positive float have the order of its value: the upper bits select the bin.
constexpr int kSizeShift = 19, kSizes = 1 << (31 - kSizeShift);

std::uint32_t binOf(float value) {
  const float size = std::abs(value);
  std::uint32_t bits;
  std::memcpy(&bits, &size, sizeof bits);
  return bits >> kSizeShift;
}

}  // namespace

float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank) {
  std::vector<std::size_t> counts(kSizes, 0);
  std::mutex adding;
  parallelRanges(static_cast<int>(parts.size()), kPartsPerTask, [&](int begin, int end) {
    std::vector<std::size_t> own(kSizes, 0);
    for (int part = begin; part < end; ++part)
      for (const float value : parts[static_cast<std::size_t>(part)]) ++own[binOf(value)];
    const std::lock_guard<std::mutex> lock(adding);
    for (std::size_t bin = 0; bin < own.size(); ++bin) counts[bin] += own[bin];
  });
  std::size_t bin = 0;
  for (; counts[bin] <= rank; ++bin) rank -= counts[bin];
  std::vector<float> within;
  for (const std::vector<float>& part : parts)
    for (const float value : part)
      if (binOf(value) == bin) within.push_back(std::abs(value));
  const auto at = within.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(within.begin(), at, within.end());
  return *at;
}

float absoluteMedian(const std::vector<std::vector<float>>& parts) {
  std::size_t count = 0;
  for (const std::vector<float>& part : parts) count += part.size();
  return count > 0 ? absoluteOfRank(parts, count / 2) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace softscope
