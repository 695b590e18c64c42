#include "fusion/colour_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "core/parallel.h"
#include "fusion/colour_levels.h"

namespace softscope {
namespace {

constexpr int kBins = 512;  // of log2(ratio), from -2 to 2; 1 is the middle of one
constexpr float kBinsPerOctave = kBins / 4.0f;
constexpr int kDarkest = 16;  // below it quantisation spoils the ratio
constexpr int kFewestPoints = 100;
constexpr std::size_t kMostPoints = 20000;  // an even subset tells the median well enough

/// Counts of log2(ratio).
struct RatioHistogram {
  std::array<int, kBins> counts{};
  int total = 0;

  void add(float ratio) {
    const float bin = (std::log2(ratio) + 2) * kBinsPerOctave + 0.5f;
    if (!(bin >= 0 && bin < kBins)) return;
    ++counts[static_cast<std::size_t>(bin)];
    ++total;
  }

  void operator+=(const RatioHistogram& other) {
    for (std::size_t bin = 0; bin < counts.size(); ++bin) counts[bin] += other.counts[bin];
    total += other.total;
  }

  float median() const {
    if (total < kFewestPoints) return 1;
    int bin = 0;
    for (int below = 0; below + counts[bin] <= total / 2; ++bin) below += counts[bin];
    const float ratio = std::exp2(static_cast<float>(bin) / kBinsPerOctave - 2);
    return std::clamp(ratio, 0.5f, 2.0f);
  }
};

bool usable(Rgb8 colour, const ColourOptions& options) {
  return std::min({colour.red, colour.green, colour.blue}) >= kDarkest &&
         std::max({colour.red, colour.green, colour.blue}) < 250 && !isHighlight(colour, options);
}

}  // namespace

ColourGain estimateGain(const PointModel& model, const Observation& observation,
                        const Visibility& visibility, const ColourOptions& options) {
  if (!options.compensate_gain || observation.colour.empty()) return {};
  const std::size_t stride = 1 + model.size() / kMostPoints;
  const int count = static_cast<int>((model.size() + stride - 1) / stride);
  RatioHistogram red, green, blue;
  std::mutex adding;
  parallelRanges(count, kPointsATask / 2, [&](int begin, int end) {
    RatioHistogram own_red, own_green, own_blue;
    for (int k = begin; k < end; ++k) {
      const std::size_t i = static_cast<std::size_t>(k) * stride;
      const PointSight& point = visibility.points[i];
      if (point.sight != Sight::kSeen) continue;
      const Rgb8 seen = observation.colour.values[static_cast<std::size_t>(point.pixel)];
      const Rgb8 known = model.colours[i];
      if (!usable(seen, options) || !usable(known, options)) continue;
      own_red.add(static_cast<float>(seen.red) / known.red);
      own_green.add(static_cast<float>(seen.green) / known.green);
      own_blue.add(static_cast<float>(seen.blue) / known.blue);
    }
    const std::lock_guard<std::mutex> lock(adding);  // whole numbers: in any order
    red += own_red, green += own_green, blue += own_blue;
  });
  return {red.median(), green.median(), blue.median()};
}

Rgb8 modelColour(Rgb8 seen, const ColourGain& gain) {
  return scaled(seen, 1 / gain.red, 1 / gain.green, 1 / gain.blue);
}

}  // namespace softscope
