// src/io/sequences/frame_loader.h: one frame from all its files.
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

/// Not for two threads at once; frames must be asked for in rising order.
class FrameLoader {
 public:
  /// Opens everything, pairs images, masks and depth files by the numbers in their names (by
  /// order where they have none), checks counts. Throws InputError.
  FrameLoader(const SequencePaths& paths, const SequenceOptions& options);

  int count() const { return count_; }

  /// The first frame of which there are all views.
  int firstWithPartner() const;

  const StereoCalibration& calibration() const { return calibration_; }
  bool survivesErrors() const;

  /// Throws InputError, also where the right view has no image of that moment. The first call
  /// settles the layout of packed images, and the image size
  /// where the calibration left it out.
  Frame load(int index);

  FrameNames namesOf(int index) const;
  /// Whether the other view has an image of this moment.
  bool hasPartner(int index) const;

  /// Of its timestamp, or its place in a video; NaN where neither is known.
  double timeOf(int index) const;

 private:
  void setCalibration(const SequencePaths& paths);
  StereoPair readPair(int index);
  void requirePartner(int index) const;
  void settleSize(const ColourImage& left, const std::string& name);
  void requireShape(int width_px, int height_px, const std::string& name) const;

  SequenceOptions options_;
  int right_offset_;
  std::filesystem::path left_path_, right_path_;  // left_path_: or of both views
  StereoCalibration calibration_;
  std::unique_ptr<PictureSource> left_, right_;  // left_ alone where both views are packed in it
  bool is_packed_ = false;
  bool is_settled_ = false;
  StereoPacking packing_;
  int count_ = 0;
  std::vector<std::filesystem::path> masks_, depths_;  // empty, or one a frame
  std::vector<double> times_s_;                        // empty, or one a frame
};

}  // namespace softscope
