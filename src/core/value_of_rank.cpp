#include "core/value_of_rank.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kPartsPerTask = 32;
constexpr int kSizeShift = 19, kSizes = 1 << (31 - kSizeShift);

}  // namespace

SizeCounts::SizeCounts() : counts_(kSizes, 0) {}

std::uint32_t SizeCounts::binOf(float value) {
  const float size = std::abs(value);
  std::uint32_t bits;
  std::memcpy(&bits, &size, sizeof bits);
  return bits >> kSizeShift;
}

void SizeCounts::add(const SizeCounts& others) {
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) counts_[bin] += others.counts_[bin];
}

std::size_t SizeCounts::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
}

SizeCounts::Place SizeCounts::placeOf(std::size_t rank) const {
  Place place{0, rank};
  for (; counts_[place.bin] <= place.rank; ++place.bin) place.rank -= counts_[place.bin];
  return place;
}

float SizeCounts::valueAt(const Place& place, std::vector<float>* in_bin) {
  const auto at = in_bin->begin() + static_cast<std::ptrdiff_t>(place.rank);
  std::nth_element(in_bin->begin(), at, in_bin->end());
  return *at;
}

float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank) {
  SizeCounts counts;
  std::mutex adding;
  parallelRanges(static_cast<int>(parts.size()), kPartsPerTask, [&](int begin, int end) {
    SizeCounts own;
    for (int part = begin; part < end; ++part)
      for (const float value : parts[static_cast<std::size_t>(part)]) own.add(value);
    const std::lock_guard<std::mutex> lock(adding);
    counts.add(own);
  });
  const SizeCounts::Place place = counts.placeOf(rank);
  std::vector<float> within;
  for (const std::vector<float>& part : parts)
    for (const float value : part)
      if (SizeCounts::binOf(value) == place.bin) within.push_back(std::abs(value));
  return SizeCounts::valueAt(place, &within);
}

}  // namespace softscope
