#include "fusion/colour_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr float kBinsPerOctave = kGainBins / 4.0f;
constexpr int kFewestPoints = 100;

/// Counts of the ratios of one channel.
struct RatioHistogram {
  std::array<int, kGainBins> counts{};

  void add(std::uint8_t seen, std::uint8_t known) {
    const int bin = gainBin(seen, known);
    if (bin >= 0) ++counts[static_cast<std::size_t>(bin)];
  }
  void operator+=(const RatioHistogram& other) {
    for (std::size_t bin = 0; bin < counts.size(); ++bin) counts[bin] += other.counts[bin];
  }
  float median() const { return gainOf(counts.data()); }
};

}  // namespace

int gainBin(std::uint8_t seen, std::uint8_t known) {
  const float ratio = static_cast<float>(seen) / known;
  const float bin = (std::log2(ratio) + 2) * kBinsPerOctave + 0.5f;
  return bin >= 0 && bin < kGainBins ? static_cast<int>(bin) : -1;
}

float gainOf(const int* counts) {
  const int total = std::accumulate(counts, counts + kGainBins, 0);
  if (total < kFewestPoints) return 1;
  int bin = 0;
  for (int below = 0; below + counts[bin] <= total / 2; ++bin) below += counts[bin];
  const float ratio = std::exp2(static_cast<float>(bin) / kBinsPerOctave - 2);
  return std::clamp(ratio, 0.5f, 2.0f);
}

ColourGain estimateGain(const PointModel& model, const Observation& observation,
                        const Visibility& visibility, const ColourOptions& options) {
  if (!options.compensate_gain || observation.colour.empty()) return {};
  const std::size_t stride = gainStride(model.size());
  const int count = static_cast<int>((model.size() + stride - 1) / stride);
  RatioHistogram red, green, blue;
  std::mutex adding;
  parallelRanges(count, kPointsPerTask / 2, [&](int begin, int end) {
    RatioHistogram own_red, own_green, own_blue;
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k) * stride;
      const PointSight& point = visibility.points[i];
      if (point.sight != Sight::kSeen) continue;
      const Rgb8 seen = observation.colour.values[static_cast<std::size_t>(point.pixel)];
      const Rgb8 known = model.colours[i];
      if (!isUsableForGain(seen, options) || !isUsableForGain(known, options)) continue;
      own_red.add(seen.red, known.red);
      own_green.add(seen.green, known.green);
      own_blue.add(seen.blue, known.blue);
    }
    const std::lock_guard<std::mutex> lock(adding);  // integers: in any order
    red += own_red, green += own_green, blue += own_blue;
  });
  return {red.median(), green.median(), blue.median()};
}

}  // namespace softscope
