// tests/mutation/faults.h: faults of the machine at the n-th write or rename of a process.
#pragma once

#include <string>

namespace softscope::test {

/// What the process that is armed and the one that armed it share.
struct FaultCounter {
  long events = 0;
  long failed_writes = 0;
};

/// `kind` is `none` (events are counted alone), `kill` (SIGKILL in the middle of the event), `full`
/// (from this event on every write to a file fails with ENOSPC), `error` (this event alone fails
/// with EIO), `term` (SIGTERM is raised before it), or `timer` (SIGTERM comes after `event`
/// microseconds, 1 or more). Events: each write to a regular file other than stdout and stderr,
/// each rename and each removal. Events are counted from 1.
void armFault(const std::string& kind, long event, FaultCounter* counter);

}  // namespace softscope::test
