// src/io/sequences/frame_window.h: sliding window of three frames of a sequence.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "io/sequences/sequence_reader.h"

namespace softscope {

/// References to the three frames stay valid until advance() has passed them.
class FrameWindow {
 public:
  explicit FrameWindow(SequenceReader& reader) : reader_(reader) {}
  FrameWindow(const FrameWindow&) = delete;
  FrameWindow& operator=(const FrameWindow&) = delete;

  /// Reads until the two frames after the next one are available;
  /// null after the last frame. Throws as the reader does.
  const FrameResult* advance() {
    if (!begun_) {
      read(1);
      read(2);
    }
    begun_ = true;
    current_ = (current_ + 1) % kSlots;
    read(2);
    return slot(0) ? &*slot(0) : nullptr;
  }
  /// Next frame; null if absent or unreadable.
  const Frame* following() const { return frameAt(1); }
  /// Frame after following(); null if either is absent or unreadable.
  const Frame* afterFollowing() const { return following() ? frameAt(2) : nullptr; }

 private:
  static constexpr std::size_t kSlots = 3;

  /// `ahead` of the current frame.
  const std::optional<FrameResult>& slot(std::size_t ahead) const {
    return slots_[(current_ + ahead) % kSlots];
  }
  const Frame* frameAt(std::size_t ahead) const {
    return slot(0) && slot(ahead) && slot(ahead)->ok() ? &slot(ahead)->frame : nullptr;
  }
  /// The slot stays empty after the last frame.
  void read(std::size_t ahead) {
    const bool goes_on = ahead == 1 || slot(ahead - 1).has_value();
    slots_[(current_ + ahead) % kSlots] = goes_on ? reader_.next() : std::nullopt;
  }

  SequenceReader& reader_;
  std::array<std::optional<FrameResult>, kSlots> slots_;
  std::size_t current_ = 0;  // slot
  bool begun_ = false;
};

}  // namespace softscope
