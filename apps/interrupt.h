// apps/interrupt.h: Ctrl-C, SIGTERM and SIGHUP as a request to stop cleanly.
#pragma once

namespace softscope {

/// In its scope, the first Ctrl-C (or SIGTERM, or the SIGHUP of a closed terminal, unless nohup
/// ignores it) only sets a flag that long work looks at between frames; the second ends the program
/// at once. A command makes it before its first file, so that no work is lost to an early signal.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;
};

}  // namespace softscope
