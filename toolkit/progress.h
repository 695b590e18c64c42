// toolkit/progress.h: progress callback of long work.
#pragma once

#include <functional>
#include <string>

namespace softscope {

/// Called before the first part of long work with `done` 0, and after each part. False: stop
/// cleanly.
using Progress = std::function<bool(int done, int total)>;

/// Without a callback work runs to its end.
inline bool goesOn(const Progress& progress, int done, int total) {
  return !progress || progress(done, total);
}

/// What long work tells while it runs. Each callback may be empty.
struct WorkListener {
  Progress progress;
  std::function<void(const std::string&)> warning, note, failure;  // one line each

  void warn(const std::string& text) const {
    if (warning) warning(text);
  }
  /// Of a part of the work; the rest goes on.
  void fail(const std::string& text) const {
    if (failure) failure(text);
  }
  void tell(const std::string& text) const {
    if (note) note(text);
  }
};

}  // namespace softscope
