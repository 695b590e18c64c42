// src/stereo/rectification/view_synchrony.h: time offset between both views of a clip.
#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "stereo/rectification/row_meter.h"

namespace softscope {

/// Time offset of the right images.
struct ViewSynchrony {
  int right_offset = 0;    // right image f + right_offset belongs to left image f
  int agreeing = 0;        // matches whose rows agree with those of all frames, with this offset
  int agreeing_as_is = 0;  // … and with equal numbers
};

/// How far the rows of a clip can be believed.
struct RowDoubt {
  RowPlane rows;  // SynchronyMeter::rowsAt()
  int matches = 0;
  double agreeing_share = 0;  // of the matches, with the rows of all frames
  double fan_px = 0;          // of the row difference's model, by x y in half widths: a yaw's
  bool is_strong = false;     // no more agree than wrong matches do, or frames differ
  bool is_rolled = false;     // a camera is, by rollRad()
  bool is_scaled = false;     // the focal lengths of the calibration do not fit

  static constexpr double kLargestYawRad = 0.01;  // correct calibrations: half of it

  double rollRad() const { return rows.per_column; }
  double scale() const { return rows.per_row; }  // the right view is larger by this share
};

/// Two videos may have been started or cut a few images apart; then tissue that moves sideways has
/// a wrong depth, and tissue that moves up or down differs in its rows. For synchronous images,
/// row differences are the same in every frame: the error of the calibration. The offset is
/// therefore the one at which most matches of many frames agree on one row model, if the models of
/// single frames agree with it, and clearly better than without the offset (docs/stereo.md).
class SynchronyMeter {
 public:
  static constexpr int kReach = 2;  // offsets -kReach … kReach are tried
  static constexpr int kOffsets = 2 * kReach + 1;

  explicit SynchronyMeter(int disparity_max_px) : disparity_max_px_(disparity_max_px) {}

  /// One frame, rectified: rights[k] is right image f + k - kReach of left image f.
  void add(const GrayImage& left, const std::array<GrayImage, kOffsets>& rights);

  /// Whether the frames so far leave no doubt of offset 0: more frames need not be added.
  bool isClear() const;

  /// Offset 0 unless another one is clearly better: a static clip gives no information.
  ViewSynchrony result() const;

  /// Rows that all frames have in common, with this offset: the error of the calibration. A single
  /// frame does not show them where it has no texture. 0 without enough matches that agree.
  RowPlane rowsAt(int offset) const;

  /// Whether these rows are those of the calibration: not where a camera is rolled farther than is
  /// tried, or has another focal length, or where nothing matches but by chance. Few matches tell
  /// nothing.
  RowDoubt doubtAt(int offset) const;

 private:
  using FrameMatches = std::vector<RowMatch>;

  const std::vector<FrameMatches>& framesAt(int offset) const { return frames_[offset + kReach]; }
  FrameMatches allAt(int offset) const;
  RowAlignment modelAt(int offset) const { return fitRowModel(allAt(offset), scale_, rolled_); }
  /// Pixels whose rows agree with the model of all frames.
  int agreeingAt(int offset) const;
  /// RMS difference of the known models of single frames from that of all, at their matches;
  /// infinite if none is known.
  double scatterAt(int offset) const;

  int disparity_max_px_;
  std::array<std::vector<FrameMatches>, kOffsets> frames_;
  RowAlignment scale_;
  RowPlane rolled_;  // of the first frame; known if its right camera is rolled
};

}  // namespace softscope
