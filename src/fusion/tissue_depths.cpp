#include "fusion/tissue_depths.h"

#include <cmath>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/parallel.h"
#include "core/tolerance.h"
#include "core/value_of_rank.h"

namespace softscope {
namespace {

/// Measured pixels of tissue.
struct Tally {
  SizeCounts depths, sigmas;
  int tissue_px = 0, precise_px = 0;

  void add(const Tally& other) {
    depths.add(other.depths);
    sigmas.add(other.sigmas);
    tissue_px += other.tissue_px;
    precise_px += other.precise_px;
  }
};

/// Exact medians, in two passes over the image.
class DepthCount {
 public:
  DepthCount(const DepthMap& depth, const Mask& not_tissue)
      : depth_(depth), not_tissue_(not_tissue) {
    forEachTask([&](int begin, int end) {
      Tally own;
      for (int v = begin; v < end; ++v) countRow(v, &own);
      const std::lock_guard<std::mutex> lock(adding_);
      tally_.add(own);
    });
    found_.tissue_px = tally_.tissue_px;
    found_.precise_px = tally_.precise_px;
    found_.measured_px = static_cast<int>(tally_.depths.total());
    if (found_.measured_px > 0) findMedians();
  }

  const TissueDepths& found() const { return found_; }

 private:
  bool hasSigmas() const { return !depth_.sigma_mm.empty(); }
  template <class Rows>
  void forEachTask(const Rows& rows) {
    constexpr int kRowsPerTask = 32;
    parallelRanges(not_tissue_.height_px, kRowsPerTask, rows);
  }
  bool isMeasured(int u, int v) const {
    return not_tissue_.at(u, v) == 0 && std::isfinite(depth_.depth_mm.at(u, v));
  }

  void countRow(int v, Tally* tally) const {
    for (int u = 0; u < not_tissue_.width_px; ++u) {
      tally->tissue_px += not_tissue_.at(u, v) == 0;
      if (!isMeasured(u, v)) continue;
      tally->depths.add(depth_.depth_mm.at(u, v));
      if (!hasSigmas()) continue;
      const float sigma_mm = depth_.sigma_mm.at(u, v);
      tally->sigmas.add(sigma_mm);
      tally->precise_px += sigma_mm <= kPreciseSigmaMm;
    }
  }
  void findMedians() {
    const SizeCounts::Place depth = tally_.depths.placeOfMedian();
    const SizeCounts::Place sigma =
        hasSigmas() ? tally_.sigmas.placeOfMedian() : SizeCounts::Place();
    std::vector<float> depths_mm, sigmas_mm;
    const auto keep = [](float value, std::uint32_t bin, std::vector<float>* kept) {
      if (SizeCounts::binOf(value) == bin) kept->push_back(std::abs(value));
    };
    forEachTask([&](int begin, int end) {
      std::vector<float> own_depths_mm, own_sigmas_mm;
      for (int v = begin; v < end; ++v)
        for (int u = 0; u < not_tissue_.width_px; ++u) {
          if (!isMeasured(u, v)) continue;
          keep(depth_.depth_mm.at(u, v), depth.bin, &own_depths_mm);
          if (hasSigmas()) keep(depth_.sigma_mm.at(u, v), sigma.bin, &own_sigmas_mm);
        }
      const std::lock_guard<std::mutex> lock(adding_);
      depths_mm.insert(depths_mm.end(), own_depths_mm.begin(), own_depths_mm.end());
      sigmas_mm.insert(sigmas_mm.end(), own_sigmas_mm.begin(), own_sigmas_mm.end());
    });
    found_.median_mm = SizeCounts::valueAt(depth, &depths_mm);
    if (hasSigmas()) found_.median_sigma_mm = SizeCounts::valueAt(sigma, &sigmas_mm);
  }

  const DepthMap& depth_;
  const Mask& not_tissue_;
  std::mutex adding_;
  Tally tally_;
  TissueDepths found_;
};

}  // namespace

TissueDepths tissueDepths(const DepthMap& depth, const Mask& not_tissue) {
  return DepthCount(depth, not_tissue).found();
}

}  // namespace softscope
