// tests/mutation/faults.cpp: functions of the C library in front of the system's own. A symbol of
// the executable comes before that of a library, so every library of the process calls these.
#include "tests/mutation/faults.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace softscope::test {
namespace {

enum class Fault { kNone, kKill, kFull, kError, kTerminate };

struct Armed {
  Fault fault = Fault::kNone;
  long event = 0;
  FaultCounter* counter = nullptr;
};

Armed armed;  // read in the functions below, which have no other argument to carry it

bool isFile(int descriptor) {
  struct stat status {};
  return descriptor > STDERR_FILENO && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Counts an event; whether the fault has come.
bool comes() {
  if (armed.counter == nullptr) return false;
  const long event = __atomic_add_fetch(&armed.counter->events, 1, __ATOMIC_SEQ_CST);
  if (armed.fault == Fault::kNone || event < armed.event) return false;
  return armed.fault == Fault::kFull || event == armed.event;
}

/// -1 if the event fails with errno, 0 if it continues.
int strike(bool is_write) {
  switch (armed.fault) {
    case Fault::kKill:
      kill(getpid(), SIGKILL);
      return 0;
    case Fault::kTerminate:
      raise(SIGTERM);
      return 0;
    case Fault::kFull:
      if (!is_write) return 0;
      ++armed.counter->failed_writes;
      errno = ENOSPC;
      return -1;
    case Fault::kError:
      errno = EIO;
      return -1;
    case Fault::kNone:
      break;
  }
  return 0;
}

ssize_t writeHere(int descriptor, const void* bytes, std::size_t count) {
  return syscall(SYS_write, descriptor, bytes, count);
}

void startTimer(long microseconds) {
  sigevent what{};
  what.sigev_notify = SIGEV_SIGNAL;
  what.sigev_signo = SIGTERM;
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &what, &timer) != 0) return;
  itimerspec when{};
  when.it_value = {microseconds / 1000000, microseconds % 1000000 * 1000};
  timer_settime(timer, 0, &when, nullptr);
}

}  // namespace

void armFault(const std::string& kind, long event, FaultCounter* counter) {
  armed.fault = kind == "kill"    ? Fault::kKill
                : kind == "full"  ? Fault::kFull
                : kind == "error" ? Fault::kError
                : kind == "term"  ? Fault::kTerminate
                                  : Fault::kNone;
  armed.event = event;
  armed.counter = counter;
  if (kind == "timer") startTimer(event);
}

}  // namespace softscope::test

extern "C" {

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  using namespace softscope::test;
  if (!isFile(descriptor) || !comes()) return writeHere(descriptor, bytes, count);
  const bool torn = armed.fault == Fault::kKill || armed.fault == Fault::kFull;
  if (torn && count > 1) writeHere(descriptor, bytes, count / 2);
  if (strike(true) < 0) return -1;
  return writeHere(descriptor, bytes, count);
}

int rename(const char* from, const char* to) {
  if (softscope::test::comes() && softscope::test::strike(false) < 0) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned int flags) {
  if (softscope::test::comes() && softscope::test::strike(false) < 0) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

int unlink(const char* file) {
  if (softscope::test::comes() && softscope::test::strike(false) < 0) return -1;
  return static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, file, 0));
}

int remove(const char* file) {
  if (softscope::test::comes() && softscope::test::strike(false) < 0) return -1;
  struct stat status {};
  const bool folder = lstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  return static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, file, folder ? AT_REMOVEDIR : 0));
}

}  // extern "C"
