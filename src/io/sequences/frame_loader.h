// src/io/sequences/frame_loader.h: reader of one frame from all its files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/stereo_rig.h"
#include "io/sequences/frame_names.h"
#include "io/sequences/picture_source.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"
#include "io/sequences/stereo_packing.h"

namespace softscope {

/// Not thread-safe, and frames must be requested in ascending order, unless readsInAnyOrder().
class FrameLoader {
 public:
  /// Opens all parts, pairs images, masks and depth files by the numbers in
  /// their names (by order without numbers), checks counts. Throws InputError.
  FrameLoader(const SequencePaths& paths, const SequenceOptions& options);

  int count() const { return count_; }

  /// First frame with all views.
  int firstWithPartner() const;

  const StereoCalibration& calibration() const { return calibration_; }
  bool survivesErrors() const;
  /// True if several threads may load at once, in any order, after the first call of load().
  bool readsInAnyOrder() const;

  /// Throws InputError, also for a missing right
  /// image. The first call determines the packing,
  /// and the image size if the calibration has none.
  Frame load(int index);

  FrameNames namesOf(int index) const;
  /// True if the other view has an image of this time.
  bool hasPartner(int index) const;

  /// Timestamp, or position in a video; NaN if both are unknown.
  double timeOf(int index) const;

 private:
  void setCalibration(const SequencePaths& paths);
  StereoPair readPair(int index);
  Mask maskFrom(const std::filesystem::path& file) const;
  void requirePartner(int index) const;
  void determineSize(const ColourImage& left, const std::string& name);
  void requireShape(int width_px, int height_px, const std::string& name) const;

  SequenceOptions options_;
  int right_offset_;
  std::filesystem::path left_path_, right_path_;  // left_path_: possibly with both views
  StereoCalibration calibration_;
  std::unique_ptr<PictureSource> left_, right_;  // left_ only for packed views
  bool is_packed_ = false;
  bool is_settled_ = false;
  StereoPacking packing_;
  int count_ = 0;
  std::vector<std::filesystem::path> masks_, depths_;  // empty, or one per frame
  bool tissue_masks_ = false;                          // form of masks_; some are empty
  std::vector<double> times_s_;                        // empty, or one per frame
};

}  // namespace softscope
