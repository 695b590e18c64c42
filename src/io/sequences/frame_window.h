// src/io/sequences/frame_window.h: a sequence's frame together with the one after it.
#pragma once

#include <array>
#include <optional>

#include "io/sequences/sequence_reader.h"

namespace softscope {

/// Both frames stay where they are until advance() has passed them.
class FrameWindow {
 public:
  explicit FrameWindow(SequenceReader& reader) : reader_(reader) {}
  FrameWindow(const FrameWindow&) = delete;
  FrameWindow& operator=(const FrameWindow&) = delete;

  /// Reads the next frame and the one after it; null after the last. Throws as the reader does.
  const FrameResult* advance() {
    if (!begun_) slots_[1] = reader_.next();
    begun_ = true;
    current_ = 1 - current_;
    auto& after = slots_[static_cast<std::size_t>(1 - current_)];
    if (current()) after = reader_.next();
    return current() ? &*current() : nullptr;
  }
  /// The frame after the current one; null where there is none, or where it can't be read.
  const Frame* following() const {
    const auto& after = slots_[static_cast<std::size_t>(1 - current_)];
    return current() && after && after->ok() ? &after->frame : nullptr;
  }

 private:
  const std::optional<FrameResult>& current() const {
    return slots_[static_cast<std::size_t>(current_)];
  }

  SequenceReader& reader_;
  std::array<std::optional<FrameResult>, 2> slots_;
  int current_ = 0;  // slot
  bool begun_ = false;
};

}  // namespace softscope
