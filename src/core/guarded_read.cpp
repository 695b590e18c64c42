// src/core/guarded_read.cpp: child process with limits, and a pipe for its result.
#include "core/guarded_read.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <system_error>

#include "core/error.h"

namespace softscope {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uintmax_t kMegabyte = std::uintmax_t{1} << 20;
constexpr std::uintmax_t kBaseMemory = 2048 * kMegabyte;
constexpr std::uintmax_t kMemoryPerByte = 16;
constexpr int kBaseSeconds = 10;

// The first byte of the answer of the child.
constexpr char kResult = 'r', kInputFault = 'i', kOtherFault = 'o', kOutOfMemory = 'm';

bool inside_guarded_read = false;  // set once, in the child process

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kAddressSanitizer = true;
#elif defined(__has_feature)
constexpr bool kAddressSanitizer = __has_feature(address_sanitizer);
#else
constexpr bool kAddressSanitizer = false;
#endif

/// AddressSanitizer's allocator, unlike that of glibc, leaves a lock that another thread
/// holds at the fork locked in the child. Waits for threads that are about to end.
void settleThreads() {
  if (!kAddressSanitizer) return;
  constexpr int kTries = 20;
  for (int k = 0; k < kTries; ++k) {
    const std::filesystem::directory_iterator threads("/proc/self/task"), end;
    if (std::distance(threads, end) <= 1) return;
    usleep(1000);
  }
}

struct ReadLimits {
  rlim_t seconds, memory_bytes;  // in addition to those of the process
};

ReadLimits limitsFor(std::uintmax_t input_bytes, const GuardAllowance& allowance) {
  return {kBaseSeconds + input_bytes / kMegabyte + static_cast<rlim_t>(allowance.seconds),
          kBaseMemory + kMemoryPerByte * input_bytes + allowance.memory_bytes};
}

/// Address space of this process: terabytes under AddressSanitizer, for its shadow.
rlim_t mappedBytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void limitTo(int resource, rlim_t value) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

void restrictChild(const ReadLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGPIPE})
    signal(signal_number, SIG_DFL);
  limitTo(RLIMIT_CORE, 0);
  limitTo(RLIMIT_CPU, limits.seconds);
  limitTo(RLIMIT_AS, mappedBytes() + limits.memory_bytes);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
}

bool writeAll(int pipe, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(pipe, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Kind, length, bytes: a child that ends early leaves fewer bytes than the length states.
bool answer(int pipe, char kind, const std::string& bytes) {
  const std::size_t length = bytes.size();
  return writeAll(pipe, &kind, 1) &&
         writeAll(pipe, reinterpret_cast<const char*>(&length), sizeof length) &&
         writeAll(pipe, bytes.data(), length);
}

/// Splits the output of answer(); false if it is incomplete.
bool splitAnswer(std::string& bytes, char& kind) {
  constexpr std::size_t kHead = 1 + sizeof(std::size_t);
  if (bytes.size() < kHead) return false;
  std::size_t length = 0;
  kind = bytes[0];
  std::memcpy(&length, bytes.data() + 1, sizeof length);
  bytes.erase(0, kHead);
  return bytes.size() == length;
}

[[noreturn]] void beChild(int pipe, const ReadLimits& limits,
                          const std::function<std::string()>& read) {
  restrictChild(limits);
  inside_guarded_read = true;
  bool told = false;
  try {
    told = answer(pipe, kResult, read());
  } catch (const InputError& error) {
    told = answer(pipe, kInputFault, error.what());
  } catch (const std::bad_alloc&) {
    told = answer(pipe, kOutOfMemory, "");
  } catch (const std::length_error&) {  // a size larger than any memory
    told = answer(pipe, kOutOfMemory, "");
  } catch (const std::exception& error) {
    told = answer(pipe, kOtherFault, error.what());
  }
  _exit(told ? 0 : 1);  // without the parent's destructors
}

/// The child and the reading end of its pipe; destroyed together.
class ReadingChild {
 public:
  ReadingChild(const ReadLimits& limits, const std::function<std::string()>& read) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe can be opened to read a file");
    settleThreads();
    id_ = fork();
    if (id_ == 0) {
      close(ends[0]);
      beChild(ends[1], limits, read);
    }
    close(ends[1]);
    pipe_ = ends[0];
    fcntl(pipe_, F_SETPIPE_SZ, 1 << 20);  // fewer switches between the two; optional
    if (id_ < 0) {
      close(pipe_);
      throw Error("no process can be started to read a file; is the machine out of memory?");
    }
  }
  ~ReadingChild() {
    close(pipe_);
    if (id_ > 0) kill(id_, SIGKILL);
    wait();
  }
  ReadingChild(const ReadingChild&) = delete;
  ReadingChild& operator=(const ReadingChild&) = delete;

  /// The complete answer; false if it did not end in time.
  bool answerBefore(Clock::time_point deadline, std::string& bytes) const {
    for (;;) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
      pollfd waiting{pipe_, POLLIN, 0};
      const int ready =
          poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
      if (ready < 0 && errno == EINTR) continue;
      if (ready <= 0) return false;
      const std::size_t had = bytes.size();
      bytes.resize(had + kMegabyte);
      const ssize_t count = ::read(pipe_, bytes.data() + had, kMegabyte);
      bytes.resize(had + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (count < 0 && errno != EINTR) return true;
      if (count == 0) return true;
    }
  }

  /// Its status once it has ended; 0 if this process ignores SIGCHLD, because then none is known.
  int wait() {
    int status = 0;
    while (id_ > 0 && waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  int id_ = -1, pipe_ = -1;
};

[[noreturn]] void failOutOfTime(const std::string& source) {
  throw InputError(source + ": its reader came to no end; is the file damaged? Export it again");
}

[[noreturn]] void failOutOfMemory(const std::string& source, const ReadLimits& limits) {
  throw InputError(source + ": reading it takes more than " +
                   std::to_string(limits.memory_bytes / kMegabyte) +
                   " MB, so a size in its header is damaged. Export it again");
}

[[noreturn]] void failDeath(const std::string& source, int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) failOutOfTime(source);
  throw InputError(source + ": the library that reads such files broke on it (" +
                   (WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                        : "exit code " + std::to_string(WEXITSTATUS(status))) +
                   "), so it is damaged or cut short. Export it again");
}

}  // namespace

void requireRegularFile(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_status status = fs::status(file, problem);
  if (!fs::exists(status))
    throw InputError(file.string() + ": does not exist, or is a link that leads nowhere");
  if (fs::is_directory(status))
    throw InputError(file.string() + ": is a folder, but a file is expected");
  if (!fs::is_regular_file(status))
    throw InputError(file.string() + ": is a pipe or device, but a regular file is expected");
}

std::string guardedRead(const std::string& source, std::uintmax_t input_bytes,
                        const std::function<std::string()>& read, const GuardAllowance& allowance) {
  const ReadLimits limits = limitsFor(input_bytes, allowance);
  ReadingChild child(limits, read);
  std::string bytes;
  const auto deadline = Clock::now() + std::chrono::seconds(2 * limits.seconds);
  if (!child.answerBefore(deadline, bytes)) failOutOfTime(source);
  const int status = child.wait();
  char kind = kOtherFault;
  if (!splitAnswer(bytes, kind)) failDeath(source, status);
  if (kind == kOutOfMemory) failOutOfMemory(source, limits);
  if (kind == kInputFault) throw InputError(bytes);
  if (kind != kResult) throw Error(source + ": can't be read: " + bytes);
  return bytes;
}

bool insideGuardedRead() { return inside_guarded_read; }

}  // namespace softscope
