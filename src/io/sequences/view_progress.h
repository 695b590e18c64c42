// src/io/sequences/view_progress.h: detection of a view that stands still, and of equal views.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/image.h"
#include "io/sequences/frame_names.h"

namespace softscope {

/// Of the decoded pixels: equal images have equal bytes, others differ.
struct ViewDigest {
  static constexpr int kPartsAcross = 8, kPartsDown = 6;
  using Parts = std::array<float, kPartsAcross * kPartsDown>;

  std::uint64_t bytes = 0;
  Parts brightness{};  // means of green
};
struct PairDigest {
  ViewDigest left, right;
  bool left_is_flat = false;  // all pixels have one colour
};
PairDigest digestOf(const StereoPair& pair);

/// The pair of an earlier frame.
struct EarlierPair {
  int frame = 0;
  PairDigest digest;
};

/// Reason why a pair cannot show one moment from two places, in one line: its views are equal, or
/// one of them is that of the frame before while the other one's brightness changes by 1 level
/// somewhere; less may be the noise of a resting scene, of which a video repeats the other view.
/// Empty if there is none. Both views of the frame before are a repeated frame, and flat images
/// have no views to compare.
std::string viewProgressFault(const std::optional<EarlierPair>& before, const PairDigest& now,
                              const FrameNames& names);

/// Whether both images are those of the earlier pair, to the byte: no camera takes two such.
bool repeats(const PairDigest& before, const PairDigest& now);

/// What the next pair is compared with. While one view stands still, slow motion of the other adds
/// up.
EarlierPair asEarlier(const std::optional<EarlierPair>& before, int frame, const PairDigest& now);

}  // namespace softscope
