#include "pipeline/frame_view.h"

#include <algorithm>
#include <atomic>
#include <cmath>
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

/// Of a predicted error that is tolerable with a probability of 95 %.
constexpr double kPreciseSigmaMm = kTolerableErrorMm / 1.96;

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

using Rows = std::vector<std::vector<float>>;

std::size_t countOf(const Rows& rows) {
  std::size_t count = 0;
  for (const std::vector<float>& row : rows) count += row.size();
  return count;
}

DepthSummary summarise(const MeasuredFrame& measured, const Mask& not_tissue,
                       const RectifiedRig& rig) {
  DepthSummary summary;
  const Raster<float>&all_mm = measured.depth.depth_mm, &all_sigmas_mm = measured.depth.sigma_mm;
  Rows sigmas_mm(static_cast<std::size_t>(not_tissue.height_px)), depths_mm(sigmas_mm.size());
  std::atomic<int> tissue_px{0}, precise_px{0};
  parallelRows(not_tissue.height_px, [&](int v) {
    const std::size_t row = static_cast<std::size_t>(v);
    depths_mm[row].reserve(static_cast<std::size_t>(not_tissue.width_px));
    sigmas_mm[row].reserve(depths_mm[row].capacity());
    int tissue = 0, precise = 0;
    for (int u = 0; u < not_tissue.width_px; ++u) {
      if (not_tissue.at(u, v) != 0) continue;
      ++tissue;
      if (!std::isfinite(all_mm.at(u, v))) continue;
      depths_mm[row].push_back(all_mm.at(u, v));
      if (all_sigmas_mm.empty()) continue;
      sigmas_mm[row].push_back(all_sigmas_mm.at(u, v));
      precise += all_sigmas_mm.at(u, v) <= kPreciseSigmaMm;
    }
    tissue_px += tissue;
    precise_px += precise;
  });
  summary.tissue_px = tissue_px;
  summary.measured_px = static_cast<int>(countOf(depths_mm));
  if (!all_sigmas_mm.empty() && summary.measured_px > 0)
    summary.precise_share = static_cast<double>(precise_px) / summary.measured_px;
  double depth_mm = 0;
  parallelInvoke([&] { summary.median_sigma_mm = absoluteMedian(sigmas_mm); },
                 [&] { depth_mm = absoluteMedian(depths_mm); });
  const double mm_per_px = depth_mm * depth_mm / (rig.left.fx_px * rig.baseline_mm);
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
