// src/io/sequences/view_progress.h: detection of a view that stands still, and of equal views.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/image.h"
#include "io/sequences/frame_names.h"

namespace softscope {

/// Of the decoded pixels: equal images have equal digests, others differ.
struct PairDigest {
  std::uint64_t left = 0, right = 0;
  bool left_is_flat = false;  // all pixels have one colour
};
PairDigest digestOf(const StereoPair& pair);

/// The pair of an earlier frame.
struct EarlierPair {
  int frame = 0;
  PairDigest digest;
};

/// Reason why a pair cannot show one moment from two places, in one line: its views are equal, or
/// one of them is that of the frame before while the other is not. Empty if there is none. Both
/// views of the frame before are a repeated frame, and flat images have no views to compare.
std::string viewProgressFault(const std::optional<EarlierPair>& before, const PairDigest& now,
                              const FrameNames& names);

}  // namespace softscope
