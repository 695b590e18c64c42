// toolkit/progress.h: progress callback.
#pragma once

#include <functional>
#include <string>

namespace softscope {

/// Called with `done` 0 at the start, and after
/// each part. False requests a clean stop.
using Progress = std::function<bool(int done, int total)>;

/// True without a callback.
inline bool reportProgress(const Progress& progress, int done, int total) {
  return !progress || progress(done, total);
}

/// Callbacks of long work. Each may be empty.
struct WorkListener {
  Progress progress;
  std::function<void(const std::string&)> warning, note, failure;  // one line per call

  void warn(const std::string& text) const {
    if (warning) warning(text);
  }
  /// Failure of one part of the work; the other parts continue.
  void fail(const std::string& text) const {
    if (failure) failure(text);
  }
  void tell(const std::string& text) const {
    if (note) note(text);
  }
};

}  // namespace softscope
