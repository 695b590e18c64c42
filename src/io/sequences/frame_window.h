// src/io/sequences/frame_window.h: a frame of a sequence, and those that follow it.
#pragma once

#include <deque>
#include <memory>
#include <utility>

#include "io/sequences/sequence_reader.h"

namespace softscope {

/// The frames after the current one are shared with work that starts ahead of their turn.
class FrameWindow {
 public:
  static constexpr int kUpcoming = 4;

  explicit FrameWindow(SequenceReader& reader) : reader_(reader) {}

  /// Reads until the frames after the next one are available. Returns the next frame, valid until
  /// the following call; null after the last frame. Throws as the reader does.
  const FrameResult* advance() {
    if (!results_.empty()) results_.pop_front();
    while (results_.size() <= kUpcoming) {
      auto result = reader_.next();
      if (!result) break;
      results_.push_back(std::make_shared<const FrameResult>(std::move(*result)));
    }
    return results_.empty() ? nullptr : results_.front().get();
  }
  /// The frame that advance() returned last.
  std::shared_ptr<const Frame> current() const {
    return {results_.front(), &results_.front()->frame};
  }
  /// Up to the first that is unreadable.
  UpcomingFrames upcoming() const {
    UpcomingFrames frames;
    for (std::size_t i = 1; i < results_.size() && results_[i]->ok(); ++i)
      frames.emplace_back(results_[i], &results_[i]->frame);
    return frames;
  }

 private:
  SequenceReader& reader_;
  std::deque<std::shared_ptr<const FrameResult>> results_;  // of the current frame, and after it
};

}  // namespace softscope
