#include "pipeline/frame/frame_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/tolerance.h"
#include "core/value_of_rank.h"

namespace softscope {
namespace {

/// Depth per pixel of disparity, z² / (f b), up to which limits in mm hold as they are: there the
/// largest sigma of a new point, 0.5 mm, is twice the 0.1 px that stereo errs by.
constexpr double kNearMmPerPx = 2.5;

/// Limits in mm are those of near tissue and grow with what a pixel of disparity is worth. Fusion
/// compares a depth with the typical one of its frame: where all depths are worse, because the
/// tissue is far or the images are poor, they still make a model. The warp does not: tissue far
/// away bends no further than near tissue, so depth with a large sigma bends it less.
void scaleOptions(const ReconstructionOptions& options, FrameView* view) {
  view->association = options.deform.association;
  view->fusion = options.fusion;
  view->pose = options.pose;
  for (double* limit_mm :
       {&view->association.max_distance_mm, &view->fusion.visibility.max_distance_mm,
        &view->fusion.insertion.band_mm, &view->fusion.insertion.max_sigma_mm,
        &view->fusion.pixels.max_sigma_mm, &view->pose.threshold_mm})
    *limit_mm *= view->summary.limit_scale;
  const double typical_mm = view->summary.median_sigma_mm;
  if (!std::isfinite(typical_mm)) return;
  // At least half of the measured pixels may become points.
  const double excess = typical_mm / view->fusion.insertion.max_sigma_mm;
  if (excess > 1) {
    view->fusion.insertion.max_sigma_mm *= excess;
    view->fusion.pixels.max_sigma_mm *= excess;
  }
  double& reference_mm = view->fusion.points.reference_sigma_mm;
  if (reference_mm > 0) reference_mm = std::max(reference_mm, typical_mm);
}

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

/// Exact medians over the measured pixels of tissue, in two passes over the image.
class TissueDepths {
 public:
  TissueDepths(const DepthMap& depth, const Mask& not_tissue)
      : depth_(depth), not_tissue_(not_tissue) {
    forEachTask([&](int begin, int end) {
      Tally own;
      for (int v = begin; v < end; ++v) countRow(v, &own);
      const std::lock_guard<std::mutex> lock(adding_);
      tally_.add(own);
    });
    measured_px_ = tally_.depths.total();
    if (measured_px_ > 0) findMedians();
  }

  int tissuePx() const { return tally_.tissue_px; }
  int measuredPx() const { return static_cast<int>(measured_px_); }
  /// NaN without sigmas or measured pixels, as the medians.
  double preciseShare() const {
    return hasSigmas() && measured_px_ > 0 ? double(tally_.precise_px) / double(measured_px_)
                                           : kUnknown;
  }
  double medianMm() const { return median_mm_; }
  double medianSigmaMm() const { return median_sigma_mm_; }

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
    median_mm_ = SizeCounts::valueAt(depth, &depths_mm);
    if (hasSigmas()) median_sigma_mm_ = SizeCounts::valueAt(sigma, &sigmas_mm);
  }

  const DepthMap& depth_;
  const Mask& not_tissue_;
  std::mutex adding_;
  Tally tally_;
  std::size_t measured_px_ = 0;
  double median_mm_ = kUnknown, median_sigma_mm_ = kUnknown;
};

DepthSummary summarise(const MeasuredFrame& measured, const Mask& not_tissue,
                       const RectifiedRig& rig) {
  const TissueDepths depths(measured.depth, not_tissue);
  DepthSummary summary;
  summary.tissue_px = depths.tissuePx();
  summary.measured_px = depths.measuredPx();
  summary.precise_share = depths.preciseShare();
  summary.median_sigma_mm = depths.medianSigmaMm();
  const double mm_per_px =
      depths.medianMm() * depths.medianMm() / (rig.left.fx_px * rig.baseline_mm);
  if (mm_per_px > kNearMmPerPx) summary.limit_scale = mm_per_px / kNearMmPerPx;
  if (measured.rows.known()) summary.row_difference_px = measured.rows.mean_row_difference_px;
  return summary;
}

FramePictures picturesOf(const ColourImage& left, const MeasuredFrame& measured,
                         const ReconstructionOptions& options) {
  FramePictures pictures;
  pictures.not_tissue = notTissue(left, measured, options.tissue);
  pictures.live = livePicture(left, pictures.not_tissue);
  return pictures;
}

}  // namespace

FramePictures framePictures(const FrameViews& views, const ReconstructionOptions& options) {
  const ColourImage& aligned = views.aligned.pair.left;
  return picturesOf(aligned.empty() ? views.measured.left : aligned, views.measured, options);
}

FrameView viewFrame(MeasuredFrame measured, const RectifiedRig& rig,
                    const ReconstructionOptions& options) {
  FramePictures pictures = picturesOf(measured.left, measured, options);
  return viewFrame(std::move(measured), std::move(pictures), rig, options);
}

FrameView viewFrame(MeasuredFrame measured, FramePictures pictures, const RectifiedRig& rig,
                    const ReconstructionOptions& options) {
  FrameView view;
  view.measured = std::move(measured);
  view.not_tissue = std::move(pictures.not_tissue);
  view.live = std::move(pictures.live);
  view.summary = summarise(view.measured, view.not_tissue, rig);
  scaleOptions(options, &view);
  // The state of a pixel does not depend on the camera's pose.
  view.states = classifyPixels({view.measured.depth, view.measured.normals, view.measured.left,
                                view.not_tissue, rig.left, Eigen::Isometry3d::Identity()},
                               view.fusion.pixels);
  return view;
}

}  // namespace softscope
