// apps/interrupt.h: Ctrl-C, SIGTERM and SIGHUP as a request for a clean stop.
#pragma once

namespace softscope {

/// In its scope, the first Ctrl-C (or SIGTERM, or SIGHUP of a closed terminal, unless ignored
/// by nohup) only sets a flag that long work polls between frames; the second ends the program.
/// Must be created before the first output file, so that an early signal loses no work.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;
};

}  // namespace softscope
