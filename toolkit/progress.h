// toolkit/progress.h: how long work tells how far it is, and how it is stopped.
#pragma once

#include <functional>

namespace softscope {

/// Called before the first part of long work with `done` 0, and after each part. False: stop
/// cleanly.
using Progress = std::function<bool(int done, int total)>;

/// Without a callback work runs to its end.
inline bool goesOn(const Progress& progress, int done, int total) {
  return !progress || progress(done, total);
}

}  // namespace softscope
