// apps/exit_codes.h: exit codes; scripts rely on these numbers.
#pragma once

namespace softscope {

enum ExitCode {
  kDone = 0,
  kThresholdFailed = 1,
  kUsage = 2,
  kInput = 3,      // a file that can't be read or written, or is implausible
  kNoBackend = 4,  // a back end or renderer that this build or machine lacks
  kBug = 70,       // an exception that softscope never throws knowingly
  kInterrupted = 130
};

}  // namespace softscope
