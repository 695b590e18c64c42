// apps/interrupt.h: Ctrl-C asks for a clean end.
#pragma once

namespace softscope {

/// While it lives, the first Ctrl-C (or SIGTERM) only sets a flag that long work looks at between
/// frames; the second ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;
};

}  // namespace softscope
