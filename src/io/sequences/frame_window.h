// src/io/sequences/frame_window.h: a sequence's frame together with the two after it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "io/sequences/sequence_reader.h"

namespace softscope {

/// All three stay where they are until advance() has passed them.
class FrameWindow {
 public:
  explicit FrameWindow(SequenceReader& reader) : reader_(reader) {}
  FrameWindow(const FrameWindow&) = delete;
  FrameWindow& operator=(const FrameWindow&) = delete;

  /// Reads on until the two frames after the next one are there; null after the last. Throws as the
  /// reader does.
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
  /// The frame after the current one; null where there is none, or where it can't be read.
  const Frame* following() const { return frameAt(1); }
  /// The frame after following(); null as there, or where that is.
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
  /// Nothing follows the last frame.
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
