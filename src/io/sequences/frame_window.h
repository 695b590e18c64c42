// src/io/sequences/frame_window.h: sliding window of three frames of a sequence.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "io/sequences/sequence_reader.h"

namespace softscope {

/// The two frames after the current one are shared with work that starts ahead of their turn.
class FrameWindow {
 public:
  explicit FrameWindow(SequenceReader& reader) : reader_(reader) {}

  /// Reads until the two frames after the next one are available. Returns the next frame, valid
  /// until the following call; null after the last frame. Throws as the reader does.
  const FrameResult* advance() {
    for (int missing = begun_ ? 1 : kFrames; missing > 0; --missing)
      results_ = {results_[1], results_[2], read()};
    begun_ = true;
    return results_[0].get();
  }
  /// Next frame; null if absent or unreadable.
  std::shared_ptr<const Frame> following() const { return frameOf(results_[1]); }
  /// Frame after following(); null if either is absent or unreadable.
  std::shared_ptr<const Frame> afterFollowing() const {
    return following() ? frameOf(results_[2]) : nullptr;
  }

 private:
  using Shared = std::shared_ptr<const FrameResult>;
  static constexpr int kFrames = 3;

  static std::shared_ptr<const Frame> frameOf(const Shared& result) {
    return result && result->ok() ? std::shared_ptr<const Frame>(result, &result->frame) : nullptr;
  }
  Shared read() {
    auto result = reader_.next();
    return result ? std::make_shared<const FrameResult>(std::move(*result)) : nullptr;
  }

  SequenceReader& reader_;
  std::array<Shared, kFrames> results_;  // of the current frame, and the two after it
  bool begun_ = false;
};

}  // namespace softscope
