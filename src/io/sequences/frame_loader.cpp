#include "io/sequences/frame_loader.h"

#include <algorithm>
#include <cstdlib>
#include <future>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "io/calibrations/calibration_check.h"
#include "io/calibrations/one_camera.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/sequences/depth_relief.h"
#include "io/sequences/frame_pairing.h"
#include "io/sequences/timestamps_file.h"
#include "io/sequences/tissue_masks.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

void requireSequence(const SequencePaths& paths, bool uncalibrated) {
  const bool depth_alone = paths.left.empty() && paths.stereo.empty() && !paths.depth.empty();
  if (paths.left.empty() == paths.stereo.empty() && !depth_alone)
    throw OptionError("a sequence needs left and right, or stereo, and not both.");
  if (!paths.left.empty() && paths.right.empty() && paths.depth.empty())
    throw OptionError("a sequence needs right images or depth beside the left ones.");
  if (paths.calibration.empty() && !uncalibrated)
    throw OptionError("a sequence needs a calibration. Give it with `calibration=`.");
}

void requireTwoViews(const SequencePaths& paths) {
  std::error_code code;
  if (paths.left.empty() || paths.right.empty() || !paths.right_files.empty()) return;
  if (!fs::equivalent(paths.left, paths.right, code)) return;
  throw InputError(say(shown(paths.right), ": is given as left and as right view, but these are ",
                       "images of two cameras. Give the right one; if both views are in each "
                       "image of it, give it once."));
}

void requireCount(std::size_t found, int expected, const fs::path& path, const char* what) {
  if (found == static_cast<std::size_t>(expected)) return;
  throw InputError(say(shown(path), ": has ", found, " ", what, ", but the sequence has ", expected,
                       " frames; one a frame is expected."));
}

std::unique_ptr<PictureSource> openView(const fs::path& path, const std::vector<fs::path>& files) {
  return files.empty() ? openPictures(path) : openPictures(files);
}

CalibrationHints hintsFor(const SequencePaths& paths, CalibrationHints hints) {
  hints.rectified = hints.rectified || paths.rectified;
  return hints;
}

constexpr float kNearestMm = 2;  // below the focus range of any scope

/// Throws if all depths are nearer: metres read as millimetres.
void requireMillimetres(const Raster<float>& depth_mm, const std::string& name) {
  float farthest_mm = 0;
  for (const float value : depth_mm.values) farthest_mm = std::max(farthest_mm, value);
  if (farthest_mm == 0 || farthest_mm >= kNearestMm) return;
  throw InputError(say(name, ": its largest depth is ", farthest_mm,
                       " mm, but tissue lies farther than ", kNearestMm,
                       " mm. In metres? Write millimetres (of 16-bit files, say what a step is "
                       "worth: depth_unit_mm in the calibration)."));
}

}  // namespace

FrameLoader::FrameLoader(const SequencePaths& paths, const SequenceOptions& options)
    : options_(options), right_offset_(options.rightOffset()) {
  if (options_.layout == "auto" && !paths.layout.empty()) options_.layout = paths.layout;
  options.validate();
  requireSequence(paths, options.uncalibrated);
  requireTwoViews(paths);
  is_packed_ = !paths.stereo.empty();
  if (is_packed_ && right_offset_ != 0)
    throw OptionError(say("sequence.right_offset is ", options.right_offset, ", but both views of ",
                          shown(paths.stereo), " are in the same images. Leave it at auto."));
  const bool depth_alone = !is_packed_ && paths.left.empty();
  if (depth_alone) setCalibration(paths);  // contains the step of the files
  const fs::path& first = is_packed_ ? paths.stereo : depth_alone ? paths.depth : paths.left;
  left_path_ = first;
  right_path_ = paths.right;
  left_ = depth_alone ? openDepthRelief(first, calibration_.depth_unit_mm)
                      : openView(first, paths.left_files);
  count_ = left_->count();
  const ViewFiles view{first, left_->files(), count_, left_->framesPerSecond()};
  if (!paths.right.empty()) {
    right_ = openView(paths.right, paths.right_files);
    if (paths.right_files.empty())
      requirePartners(view,
                      {paths.right, right_->files(), right_->count(), right_->framesPerSecond()});
    if (std::abs(right_offset_) >= count_)
      throw OptionError(say("sequence.right_offset is ", options.right_offset, ", but there are ",
                            count_, " images: no two would belong together."));
  }
  tissue_masks_ = paths.tissue_masks;
  std::vector<std::string> warnings;
  if (tissue_masks_) {
    TissueMasks masks = findTissueMasks(paths.mask, count_);
    masks_ = std::move(masks.files);
    warnings = std::move(masks.warnings);
  } else if (fs::is_regular_file(paths.mask)) {
    masks_.assign(static_cast<std::size_t>(count_), paths.mask);
  } else if (!paths.mask.empty()) {
    masks_ = partnersIn(paths.mask, kMaskKinds, view);
  }
  if (!paths.depth_files.empty())
    depths_ = paths.depth_files;
  else if (!paths.depth.empty())
    depths_ = partnersIn(paths.depth, kDepthKinds, view);
  times_s_ = paths.times_s;
  if (!paths.timestamps.empty()) {
    times_s_ = readTimestamps(paths.timestamps);
    requireCount(times_s_.size(), count_, paths.timestamps, "times");
    if (const std::string doubt = timeUnitWarning(times_s_); !doubt.empty())
      warnings.push_back(say(shown(paths.timestamps), ": ", doubt));
  }
  if (!depth_alone) setCalibration(paths);
  for (std::string& line : warnings) calibration_.warnings.push_back(std::move(line));
}

void FrameLoader::setCalibration(const SequencePaths& paths) {
  if (paths.calibration.empty()) {
    calibration_ = uncalibrated(0, 0);
    return;
  }
  calibration_ = readCalibration(paths.calibration, hintsFor(paths, options_.calibration));
  if (paths.depth_unit_mm > 0) calibration_.depth_unit_mm = paths.depth_unit_mm;
  if (hasOneCamera(calibration_) && paths.depth.empty())
    throw InputError(
        say(calibration_.source,
            ": is one camera's, but there is no depth/ to go with it. Add depth files, "
            "or for a rectified pair the baseline (`softscope calibration-template "
            "rectified`)."));
}

int FrameLoader::firstWithPartner() const { return right_ ? std::max(0, -right_offset_) : 0; }

bool FrameLoader::survivesErrors() const {
  return left_->survivesErrors() && (!right_ || right_->survivesErrors());
}

bool FrameLoader::readsInAnyOrder() const {
  return left_->readsInAnyOrder() && (!right_ || right_->readsInAnyOrder());
}

Frame FrameLoader::load(int index) {
  requirePartner(index);  // before any read: a video cannot seek back
  Frame frame;
  frame.index = index;
  frame.time_s = timeOf(index);
  frame.pair = readPair(index);
  if (!is_settled_) determineSize(frame.pair.left, left_->nameOf(index));
  requireShape(frame.pair.left.width_px, frame.pair.left.height_px, left_->nameOf(index));
  if (right_)
    requireShape(frame.pair.right.width_px, frame.pair.right.height_px, right_->nameOf(index));
  const auto i = static_cast<std::size_t>(index);
  if (!masks_.empty() && !masks_[i].empty()) frame.mask = maskFrom(masks_[i]);
  if (!depths_.empty()) {
    frame.depth_mm = readDepth(depths_[i], calibration_.depth_unit_mm);
    requireShape(frame.depth_mm.width_px, frame.depth_mm.height_px, shown(depths_[i]));
    requireMillimetres(frame.depth_mm, shown(depths_[i]));
  }
  return frame;
}

Mask FrameLoader::maskFrom(const fs::path& file) const {
  const PinholeCamera& camera = calibration_.left.pinhole;
  if (tissue_masks_) return readTissueMask(file, camera.width_px, camera.height_px);
  Mask mask = readMask(file);
  requireShape(mask.width_px, mask.height_px, shown(file));
  return mask;
}

StereoPair FrameLoader::readPair(int index) {
  if (!is_packed_) {
    std::future<ColourImage> right;
    if (right_)
      right = std::async(threadCount() > 1 ? std::launch::async : std::launch::deferred,
                         [this, index] { return right_->read(index + right_offset_); });
    ColourImage left = left_->read(index);
    return {std::move(left), right_ ? right.get() : ColourImage{}};
  }
  const ColourImage packed = left_->read(index);
  const PinholeCamera& camera = calibration_.left.pinhole;
  if (!is_settled_)
    packing_ = choosePacking(packed, options_.layout, options_.right_first,
                             {camera.width_px, camera.height_px}, left_->nameOf(index));
  return unpack(packed, packing_, left_->nameOf(index));
}

bool FrameLoader::hasPartner(int index) const {
  const int partner = index + right_offset_;
  return !right_ || (partner >= 0 && partner < count_);
}

FrameNames FrameLoader::namesOf(int index) const {
  const auto nameIn = [](const PictureSource& view, const fs::path& path, int i) {
    const std::vector<fs::path> files = view.files();
    return (files.empty() ? path : files.at(static_cast<std::size_t>(i))).filename();
  };
  const fs::path left = nameIn(*left_, left_path_, index);
  const bool is_file = !left_->files().empty();
  FrameNames names;
  names.number = (is_file ? frameNumber(left) : std::nullopt).value_or(index);
  names.left = left.string();
  if (right_ && hasPartner(index))
    names.right = nameIn(*right_, right_path_, index + right_offset_).string();
  return names;
}

void FrameLoader::requirePartner(int index) const {
  if (!hasPartner(index))
    throw InputError(say(left_->nameOf(index), ": the right view has no image of this moment ",
                         "(sequence.right_offset is ", options_.right_offset, ")"));
}

void FrameLoader::determineSize(const ColourImage& left, const std::string& name) {
  is_settled_ = true;
  PinholeCamera& camera = calibration_.left.pinhole;
  if (camera.width_px != 0 && camera.height_px != 0) return;
  if (isUncalibrated(calibration_)) {
    calibration_ = uncalibrated(left.width_px, left.height_px);
    return;
  }
  camera.width_px = calibration_.right.pinhole.width_px = left.width_px;
  camera.height_px = calibration_.right.pinhole.height_px = left.height_px;
  calibration_.warnings.push_back(say(calibration_.source, ": doesn't say for which image size it ",
                                      "holds; taken to be ", name, "'s ", left.width_px, " x ",
                                      left.height_px, "."));
  for (std::string& line : checkPictureFit(calibration_))
    calibration_.warnings.push_back(std::move(line));
  for (std::string& line : checkAssumedSize(calibration_))
    calibration_.warnings.push_back(std::move(line));
}

void FrameLoader::requireShape(int width_px, int height_px, const std::string& name) const {
  const PinholeCamera& camera = calibration_.left.pinhole;
  if (width_px == camera.width_px && height_px == camera.height_px) return;
  throw InputError(say(name, ": ", width_px, " x ", height_px, " pixels, but ", calibration_.source,
                       " is for ", camera.width_px, " x ", camera.height_px,
                       ". Give the calibration made for this size."));
}

double FrameLoader::timeOf(int index) const {
  if (!times_s_.empty()) return times_s_[static_cast<std::size_t>(index)];
  const double rate_hz = left_->framesPerSecond();
  return rate_hz > 0 ? index / rate_hz : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace softscope
