#include "pipeline/frame/frame_depth.h"

#include <utility>

#include "core/error.h"
#include "stereo/depth/depth_from_disparity.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/stage_clock.h"
#include "stereo/rectification/image_border.h"
#include "stereo/refinement/clipped_mask.h"
#include "stereo/refinement/grey_foreground.h"
#include "stereo/refinement/mask_leaks.h"

namespace softscope {

FrameDepth::FrameDepth(const StereoCalibration& calibration, const FrameDepthOptions& options,
                       const StereoStageFactory& makeStage)
    : options_(options),
      calibration_source_(calibration.source),
      rectified_(calibration.rectified),
      rows_(calibration.rows),
      rectifier_(calibration),
      stage_(makeStage(options.stereo, rectifier_.rig())) {
  options_.stereo = options.stereo.forWidth(rig().left.width_px);
  options_.validate();
  if (options.source == "files") requireRectified();
}

/// Depth files belong to the unrectified images.
void FrameDepth::requireRectified() const {
  if (!rectified_)
    throw InputError(calibration_source_ +
                     ": the sequence has depth/, but depth files belong to rectified (undistorted) "
                     "images. Are these? Then write `rectified: 1`; else set depth.source=stereo");
}

bool FrameDepth::takesFile(const Frame& frame) const {
  return options_.source == "files" || (options_.source == "auto" && !frame.depth_mm.empty());
}

FrameViews FrameDepth::viewsOf(const Frame& frame) const {
  if (!takesFile(frame)) return align(frame);
  FrameViews views;
  takeFile(frame, views.measured);
  return views;
}

void FrameDepth::takeFile(const Frame& frame, MeasuredFrame& measured) const {
  if (frame.depth_mm.empty())
    throw InputError("depth.source is files, but there is no depth/. Leave it at auto");
  requireRectified();
  measured.method = "files";
  measured.left = frame.pair.left;
  measured.mask = frame.mask;
  measured.depth.depth_mm = frame.depth_mm;
  StageClock clock;
  dropMasked(measured.mask, &measured.depth.depth_mm);
  measured.normals = normalsFromDepth(measured.depth.depth_mm, rig().left);
  clock.lap("normals");
  measured.times = clock.laps();
}

FrameViews FrameDepth::align(const Frame& frame) const {
  if (frame.pair.right.empty())
    throw InputError("there is no right view to match, and no depth/ to take its place");
  FrameViews views;
  MeasuredFrame& measured = views.measured;
  AlignedPair& aligned = views.aligned;
  StageClock clock;
  StereoPair rectified = rectifier_.rectify(frame.pair);
  if (!frame.mask.empty()) views.instruments = rectifier_.rectifyMask(frame.mask);
  const Mask& known = frame.mask.empty() ? rectifier_.outside().left : views.instruments;
  // Instruments are masked afterwards: their mask is that of one view, and
  // weak texture next to them needs the wide windows of the coarser sizes.
  const ViewMasks ignored = pixelsToIgnore(rectified, rectifier_, options_.find_border);
  measured.mask = united(known, ignored.left);
  measured.border = ignored.left;
  clock.lap("rectify");
  const auto align = options_.align_rows ? alignRows : withoutAlignment;
  aligned = align(std::move(rectified), options_.stereo.disparity_max_px, ignored, rows_);
  measured.rows = aligned.before;
  measured.rows_aligned = aligned.removed;
  clock.lap("rows");
  views.prepared = stage_->prepare(aligned);
  views.clipped = clippedMask(aligned.pair.left);
  clock.lap("masks");
  measured.times = clock.laps();
  return views;
}

MeasuredFrame FrameDepth::measure(FrameViews views) {
  std::future<NormalMap> normals;
  MeasuredFrame measured = measure(std::move(views), &normals);
  if (normals.valid()) measured.normals = normals.get();
  return measured;
}

MeasuredFrame FrameDepth::measure(FrameViews views, std::future<NormalMap>* normals) {
  MeasuredFrame measured = std::move(views.measured);
  AlignedPair& aligned = views.aligned;
  if (aligned.pair.left.empty()) return measured;
  StereoSurface found = stage_->measure(aligned, views.prepared, measured.mask);
  if (!views.instruments.empty()) {
    stage_->fetchDisparity(&found);
    stage_->drop(leaksOf(views.instruments, found.disparity.disparity_px), &found);
  }
  stage_->drop(views.clipped, &found);
  if (options_.detect_instruments)
    stage_->drop(greyForeground(aligned.pair.left, found.depth.depth_mm, rig().left), &found);
  *normals = stage_->fetchNormals();
  measured.disparity = std::move(found.disparity);
  measured.depth = std::move(found.depth);
  measured.normals = std::move(found.normals);
  measured.left = std::move(aligned.pair.left);
  measured.method = stage_->name();
  measured.times.insert(measured.times.end(), found.times.begin(), found.times.end());
  return measured;
}

}  // namespace softscope
