#include "pipeline/frame/frame_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/background_work.h"
#include "core/parallel.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

/// Depth per pixel of disparity, z² / (f b), up to which limits in mm hold as they are: there the
/// largest sigma of a new point, 0.5 mm, is twice the 0.1 px that stereo errs by.
constexpr double kNearMmPerPx = 2.5;

/// Sigma of the disparity of a new point: a pixel, or a few of the frame's typical ones. Beyond, it
/// may be that of another structure, or of smoke; near the scope that is little in mm.
constexpr double kMostSigmaPx = 1, kMostOfTypical = 3;

/// Limits in mm are those of near tissue and grow with what a pixel of disparity is worth. Fusion
/// compares a depth with the typical one of its frame: where all depths are worse, because the
/// tissue is far or the images are poor, they still make a model. The warp does not: tissue far
/// away bends no further than near tissue, so depth with a large sigma bends it less.
void scaleOptions(const ReconstructionOptions& options, const RectifiedRig& rig, FrameView* view) {
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
  const double most_px =
      std::max(kMostSigmaPx, kMostOfTypical * typical_mm / view->summary.mm_per_px);
  view->fusion.insertion.max_sigma_over_square_per_mm =
      most_px / (rig.left.fx_px * rig.baseline_mm);
  // At least half of the measured pixels may become points.
  const double excess = typical_mm / view->fusion.insertion.max_sigma_mm;
  if (excess > 1) {
    view->fusion.insertion.max_sigma_mm *= excess;
    view->fusion.pixels.max_sigma_mm *= excess;
  }
  double& reference_mm = view->fusion.points.reference_sigma_mm;
  if (reference_mm > 0) reference_mm = std::max(reference_mm, typical_mm);
}

/// Behind and around an organ in the distance there is no light. Where that is nearly everything,
/// the rest is no view of tissue.
constexpr int kLeastLitPart = 5;  // a fifth

int litPx(const TissueDepths& depths, int dark_px) {
  return std::max(
      {depths.tissue_px - dark_px, depths.tissue_px / kLeastLitPart, depths.measured_px});
}

int darkPx(const GrayImage& gray, const Mask& not_tissue) {
  int dark = 0;
  for (std::size_t i = 0; i < gray.values.size(); ++i)
    dark += not_tissue.values[i] == 0 && gray.values[i] < StereoOptions::darkest_gray ? 1 : 0;
  return dark;
}

DepthSummary summarise(const TissueDepths& depths, const MeasuredFrame& measured, int dark_px,
                       const RectifiedRig& rig) {
  DepthSummary summary;
  summary.tissue_px = litPx(depths, dark_px);
  summary.measured_px = depths.measured_px;
  if (depths.measured_px > 0 && !measured.depth.sigma_mm.empty())
    summary.precise_share = double(depths.precise_px) / depths.measured_px;
  summary.median_sigma_mm = depths.median_sigma_mm;
  summary.mm_per_px = depths.median_mm * depths.median_mm / (rig.left.fx_px * rig.baseline_mm);
  if (summary.mm_per_px > kNearMmPerPx) summary.limit_scale = summary.mm_per_px / kNearMmPerPx;
  if (measured.rows.known()) summary.row_difference_px = measured.rows.mean_row_difference_px;
  return summary;
}

FramePictures picturesOf(const ColourImage& left, GrayImage gray, const MeasuredFrame& measured,
                         const ReconstructionOptions& options) {
  FramePictures pictures;
  pictures.not_tissue = notTissue(left, measured, options.tissue);
  pictures.dark_px = darkPx(gray, pictures.not_tissue);
  pictures.live = livePicture(left, std::move(gray), pictures.not_tissue);
  return pictures;
}

/// On a thread of its own, if there are several.
std::shared_future<LevelledRelief> beginLevelling(const Raster<float>& depth_mm,
                                                  const RectifiedRig& rig) {
  const auto work = [squares = depthOfSquares(depth_mm), rig] {
    LevelledRelief relief;
    runInBackground([&] { relief = levelledRelief(squares, rig); });
    return relief;
  };
  return std::async(threadCount() > 1 ? std::launch::async : std::launch::deferred, work).share();
}

}  // namespace

FramePictures framePictures(const FrameViews& views, const ReconstructionOptions& options) {
  return picturesOf(views.left(), views.leftGray(), views.measured, options);
}

FrameView viewFrame(MeasuredFrame measured, const RectifiedRig& rig,
                    const ReconstructionOptions& options) {
  FramePictures pictures = picturesOf(measured.left, toGray(measured.left), measured, options);
  CpuFrameSurvey survey;
  return viewFrame(std::move(measured), std::move(pictures), rig, options, &survey);
}

FrameView viewFrame(MeasuredFrame measured, FramePictures pictures, const RectifiedRig& rig,
                    const ReconstructionOptions& options, FrameSurvey* survey) {
  FrameView view;
  view.measured = std::move(measured);
  view.not_tissue = std::move(pictures.not_tissue);
  view.live = std::move(pictures.live);
  // Neither depends on the camera's pose.
  const Observation frame = observationOf(view, rig.left);
  view.summary = summarise(survey->depthsOf(frame), view.measured, pictures.dark_px, rig);
  scaleOptions(options, rig, &view);
  view.states = survey->statesOf(frame, view.fusion.pixels);
  view.levelled = beginLevelling(view.measured.depth.depth_mm, rig);
  return view;
}

}  // namespace softscope
