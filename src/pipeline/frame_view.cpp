#include "pipeline/frame_view.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/median.h"

namespace softscope {
namespace {

/// Depth per pixel of disparity, z² / (f b), up to which limits in mm hold as they are: there the
/// largest sigma of a new point, 0.5 mm, is twice the 0.1 px that stereo errs by.
constexpr double kNearMmPerPx = 2.5;

/// Limits in mm are those of near tissue and grow with what a pixel of disparity is worth. Fusion
/// compares a depth with the typical one of its frame: where all depths are worse, because the
/// tissue is far or the images are poor, they still make a model. The warp does not: tissue far
/// away bends no further than near tissue, so unsure depth bends it less.
void scaleOptions(const ReconstructionOptions& options, FrameView* view) {
  view->association = options.deform.association;
  view->fusion = options.fusion;
  view->pose = options.pose;
  for (double* limit_mm :
       {&view->association.max_distance_mm, &view->fusion.visibility.max_distance_mm,
        &view->fusion.insertion.band_mm, &view->fusion.insertion.max_sigma_mm,
        &view->fusion.pixels.max_sigma_mm, &view->pose.threshold_mm})
    *limit_mm *= view->summary.limit_scale;
  double& sigma_mm = view->fusion.points.reference_sigma_mm;
  if (sigma_mm > 0 && std::isfinite(view->summary.median_sigma_mm))
    sigma_mm = std::max(sigma_mm, view->summary.median_sigma_mm);
}

DepthSummary summarise(const MeasuredFrame& measured, const Mask& not_tissue,
                       const RectifiedRig& rig) {
  DepthSummary summary;
  std::vector<float> sigmas, depths_mm;
  for (std::size_t i = 0; i < not_tissue.size(); ++i) {
    if (not_tissue.values[i] != 0) continue;
    ++summary.tissue_px;
    if (!std::isfinite(measured.depth.depth_mm.values[i])) continue;
    ++summary.measured_px;
    depths_mm.push_back(measured.depth.depth_mm.values[i]);
    if (!measured.depth.sigma_mm.empty()) sigmas.push_back(measured.depth.sigma_mm.values[i]);
  }
  summary.median_sigma_mm = medianOf(std::move(sigmas));
  const double depth_mm = medianOf(std::move(depths_mm));
  const double mm_per_px = depth_mm * depth_mm / (rig.left.fx_px * rig.baseline_mm);
  if (mm_per_px > kNearMmPerPx) summary.limit_scale = mm_per_px / kNearMmPerPx;
  if (measured.rows.known()) summary.row_difference_px = measured.rows.mean_row_difference_px;
  return summary;
}

}  // namespace

FrameView viewFrame(MeasuredFrame measured, const RectifiedRig& rig,
                    const ReconstructionOptions& options) {
  FrameView view;
  view.measured = std::move(measured);
  view.not_tissue = notTissue(view.measured, options.tissue);
  view.live = livePicture(view.measured, view.not_tissue);
  view.summary = summarise(view.measured, view.not_tissue, rig);
  scaleOptions(options, &view);
  // How sure a pixel is does not depend on where the camera stands.
  view.states = judgePixels({view.measured.depth, view.measured.normals, view.measured.left,
                             view.not_tissue, rig.left, Eigen::Isometry3d::Identity()},
                            view.fusion.pixels);
  return view;
}

}  // namespace softscope
