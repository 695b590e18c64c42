// toolkit/evaluation/evaluate_view.cpp: rendered model against the image of its frame.
#include "toolkit/evaluation/evaluate_view.h"

#include <cmath>

#include "core/error.h"
#include "eval/images/model_drawing.h"
#include "eval/images/pixel_masks.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/sequences/sequence_paths.h"
#include "io/sequences/tissue_masks.h"
#include "io/text/message.h"
#include "stereo/images/view_masks.h"
#include "stereo/rectification/image_border.h"
#include "toolkit/run/sequence_calibration.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr Rgb8 kNothingDrawn{176, 176, 176};

/// Empty for a video, a single image or a missing folder.
std::vector<fs::path> picturesIn(const fs::path& folder) {
  std::error_code ignored;
  if (folder.empty() || !fs::is_directory(folder, ignored)) return {};
  return filesIn(folder, {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm"});
}

SequencePaths pathsOrNone(const fs::path& sequence) {
  try {
    return findSequence(sequence);
  } catch (const InputError&) {  // ground truth without images
    return {};
  }
}

void requireSize(int width_px, int height_px, const PinholeCamera& left, const fs::path& file) {
  if (width_px != left.width_px || height_px != left.height_px)
    throw InputError(say(shown(file), ": has ", width_px, " x ", height_px,
                         " pixels, but the calibration says ", left.width_px, " x ", left.height_px,
                         "; give images of this camera"));
}

}  // namespace

ViewJudge::ViewJudge(const SequenceTruth& truth)
    : rig_(truth.rig), rectifier_(sequenceCalibration(truth.folder)) {
  const SequencePaths paths = pathsOrNone(truth.folder);
  pictures_ = paths.left_files.empty() ? picturesIn(paths.left) : paths.left_files;
  if (!paths.stereo.empty() || isVideo(paths.left))
    video_ = std::make_unique<FrameLoader>(paths, SequenceOptions());
  tissue_masks_ = video_ && paths.tissue_masks;
  masks_ =
      tissue_masks_ ? findTissueMasks(paths.mask, video_->count()).files : picturesIn(paths.mask);
}

std::optional<ColourImage> ViewJudge::photograph(int frame) {
  const auto i = static_cast<std::size_t>(frame);
  if (video_ && frame < video_->count()) return rectifier_.rectify(video_->load(frame).pair).left;
  if (i >= pictures_.size()) return std::nullopt;
  ColourImage raw = readColourImage(pictures_[i]);
  requireSize(raw.width_px, raw.height_px, rig_.left, pictures_[i]);
  return rectifier_.rectify({raw, raw}).left;
}

Mask ViewJudge::instruments(int frame) const {
  const auto i = static_cast<std::size_t>(frame);
  if (i >= masks_.size() || masks_[i].empty()) return rectifier_.outside().left;
  if (tissue_masks_)
    return rectifier_.rectifyMask(
        readTissueMask(masks_[i], rig_.left.width_px, rig_.left.height_px));
  const Mask raw = readMask(masks_[i]);
  requireSize(raw.width_px, raw.height_px, rig_.left, masks_[i]);
  return rectifier_.rectifyMask(raw);
}

ViewErrors ViewJudge::judge(const ModelFile& file, const Eigen::Isometry3d& run_from_left,
                            int frame, const Raster<float>& true_depth_mm, DrawnPair* drawn) {
  const ModelDrawing view = drawModel(file.model, rig_.left, run_from_left);
  const Mask ignore = instruments(frame);
  ViewErrors errors;
  errors.depth = depthErrors(view.depth_mm, true_depth_mm, {{3}}, ignore);
  if (!file.coloured) return errors;
  const auto picture = photograph(frame);
  if (!picture) return errors;
  errors.picture = pictureErrors(view.colour, *picture, ignoreUnmeasured(view.depth_mm),
                                 united(ignore, findBorder(*picture)));
  if (drawn != nullptr) {
    *drawn = {*picture, view.colour};
    for (std::size_t i = 0; i < view.depth_mm.size(); ++i)
      if (std::isnan(view.depth_mm.values[i])) drawn->model.values[i] = kNothingDrawn;
  }
  return errors;
}

PictureErrors ViewJudge::judgeImage(const ModelFile& file, const Eigen::Isometry3d& run_from_left,
                                    int other, int frame) {
  const auto earlier = photograph(other), picture = photograph(frame);
  if (!file.coloured || !earlier || !picture) return {};
  const ModelDrawing view = drawModel(file.model, rig_.left, run_from_left);
  return pictureErrors(*earlier, *picture, ignoreUnmeasured(view.depth_mm),
                       united(instruments(frame), findBorder(*picture)));
}

}  // namespace softscope
