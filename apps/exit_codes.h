// apps/exit_codes.h: exit codes; scripts rely on these numbers.
#pragma once

namespace softscope {

enum ExitCode {
  kDone = 0,
  kThresholdFailed = 1,
  kUsage = 2,
  kInput = 3,      // an unreadable, unwritable or implausible file
  kNoBackend = 4,  // a back end or renderer missing in this build or machine
  kBug = 70,       // an exception that softscope does not expect
  kInterrupted = 130
};

}  // namespace softscope
