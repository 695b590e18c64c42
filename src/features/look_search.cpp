#include "features/look_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "features/look_kernels.h"

namespace softscope {
namespace {

/// Search of one window in one image.
class FirstLookMatcher {
 public:
  FirstLookMatcher(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore)
      : image_{image.values.data(), image.width_px, image.height_px},
        ignore_{ignore.empty() ? nullptr : ignore.values.data(), image.width_px, image.height_px} {
    ignored_.fill(1);
    std::copy(look.gray.begin(), look.gray.end(), gray_.begin());
    std::copy(look.ignore.begin(), look.ignore.end(), ignored_.begin());
    least_count_ =
        kLeastLookShare * static_cast<double>(std::count(ignored_.begin(), ignored_.end(), 0));
  }

  bool find(const LookPlace& expected, LookSearch* search) {
    if (!countPixels(search->place)) return false;
    // Another round if other pixels are masked at the position found than at the expected one.
    for (int round = 1;; ++round) {
      if (!converge(expected, search)) return false;
      if (round == kMostLookRounds) break;
      const LookPlane before = look_.weights;
      const bool enough = countPixels(search->place);
      if (std::equal(std::begin(before.values), std::end(before.values), look_.weights.values))
        break;
      if (!enough) return false;
    }
    search->converged = true;
    if (search->correlation < kLeastLookCorrelation) return false;
    search->sigma_px = sigmaAt(lookVariance(search->correlation));
    return search->sigma_px <= kLargestLookSigmaPx;
  }

 private:
  /// False if too few pixels of the window count.
  bool countPixels(const LookPlace& place) {
    if (!isInside(place, image_.width_px, image_.height_px)) return false;
    kernels_.countPixels(ignored_.data(), ignore_, placesOf(place), kLookRoomPx, &look_);
    return look_.count >= least_count_;
  }

  /// Moves the search to the position where the counted
  /// pixels agree; false if there is none near `expected`.
  bool converge(const LookPlace& expected, LookSearch* search) {
    kernels_.describeLook(gray_.data(), &look_);
    if (!(look_.contrast >= kLeastLookContrast)) return false;
    for (int step = 0;; ++step) {
      if (!isInside(search->place, image_.width_px, image_.height_px) ||
          !kernels_.sampleLook(look_, image_, placesOf(search->place), &seen_))
        return false;
      if (!(seen_.deviation > 0)) return false;
      search->correlation = correlationOf(look_, seen_);
      if (step == kMostLookSteps) return true;
      switch (stepLook(look_, seen_, expected, search->correlation, &search->place)) {
        case LookStep::kLost:
          return false;
        case LookStep::kConverged:
          return true;
        case LookStep::kGoesOn:
          break;
      }
    }
  }

  /// `variance`: lookVariance() of the search.
  double sigmaAt(double variance) const {
    LookPlane difference;
    kernels_.differenceOf(look_, seen_, &difference);
    double noise[kMapUnknowns][kMapUnknowns], place[2][kMapUnknowns], boxes[2];
    kernels_.normalOfNoise(look_, difference, noise);
    if (!placePerTerm(look_, noise, variance, place))
      return std::numeric_limits<double>::infinity();
    float terms[2][kMapUnknowns];
    for (int axis = 0; axis < 2; ++axis)
      std::transform(place[axis], place[axis] + kMapUnknowns, terms[axis],
                     [](double value) { return static_cast<float>(value); });
    kernels_.boxSums(look_, difference, terms, boxes);
    return lookSigma(look_, variance, place, boxes);
  }

  const LookKernels& kernels_ = lookKernels();
  LookImage image_, ignore_;
  std::array<std::uint8_t, kLookValues> gray_{}, ignored_;
  double least_count_ = 0;
  LookTemplate look_;
  LookSamples seen_;
};

}  // namespace

bool findWindow(const FirstLook::Window& look, const GrayImage& image, const Mask& ignore,
                const double (&expected_map)[4], LookSearch* search) {
  if (look.taken == 0) return false;
  LookPlace expected = search->place;
  std::copy(std::begin(expected_map), std::end(expected_map), expected.map);
  return FirstLookMatcher(look, image, ignore).find(expected, search);
}

}  // namespace softscope
