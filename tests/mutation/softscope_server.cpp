// tests/mutation/softscope_server.cpp: softscope's commands in a process that forks for each, or
// keeps one process for many, so that a run costs no loading of libraries.
//
// A request is a line of stdin, its fields separated by U+001F: folder to run in, file for stdout
// (`pipe`: a pipe without a reader; `closed`: none), file for stderr (the same), seconds of
// processor time, kind of fault, its event, way to exit (`whole`: with static destructors; `quick`:
// streams are flushed alone; `kept`: no exit, the next such run goes on in the same process), words
// of the command line. The answer is a line of stdout: exit code or minus the signal, milliseconds
// of processor time, largest memory in KB, counted events, writes that failed for a full disk, and
// how many runs the process had ended before.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "apps/program.h"
#include "tests/mutation/faults.h"

namespace softscope::test {
namespace {

constexpr unsigned kMostSecondsOnTheClock = 120;
constexpr long kMostKeptRuns = 2000;
constexpr long kMostKeptKb = 1 << 20;  // a largest memory stays: a larger process is not kept

struct Request {
  std::string folder, out, err;
  long seconds = 0;
  std::string fault;
  long event = 0;
  std::string exits;
  std::vector<std::string> words;
};

Request parse(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == '\x1f')
      fields.emplace_back();
    else
      fields.back() += c;
  if (fields.size() < 8) std::exit(2);
  return {fields[0], fields[1],
          fields[2], std::atol(fields[3].c_str()),
          fields[4], std::atol(fields[5].c_str()),
          fields[6], {fields.begin() + 7, fields.end()}};
}

void redirect(int stream, const std::string& file) {
  if (file == "closed") {
    close(stream);
    return;
  }
  int ends[2] = {-1, -1};
  if (file == "pipe") {
    if (pipe(ends) != 0) _exit(126);
    close(ends[0]);
  } else {
    ends[1] = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  }
  if (ends[1] < 0 || dup2(ends[1], stream) < 0) _exit(126);
  close(ends[1]);
}

/// The destructors of 300 libraries take five sixths of the processor time of a run that ends with
/// an input error: they write into pages that were shared with the parent until then.
[[noreturn]] void exitQuickly(int code) {
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
  _exit(code);
}

/// What a run took, of its process and of those that it waited for.
struct Usage {
  long cpu_ms = 0, memory_kb = 0;
};

Usage usageOf(const rusage& used) {
  return {(used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1000 +
              (used.ru_utime.tv_usec + used.ru_stime.tv_usec) / 1000,
          used.ru_maxrss};
}

Usage usageSoFar() {
  rusage own{}, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  const Usage a = usageOf(own), b = usageOf(children);
  return {a.cpu_ms + b.cpu_ms, std::max(a.memory_kb, b.memory_kb)};
}

/// Streams, folder and limits of a run.
void setUp(const Request& request, FaultCounter* counter) {
  if (chdir(request.folder.c_str()) != 0) _exit(126);
  redirect(STDOUT_FILENO, request.out);
  redirect(STDERR_FILENO, request.err);
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  rusage own{};
  getrusage(RUSAGE_SELF, &own);
  limit.rlim_cur = static_cast<rlim_t>(request.seconds + own.ru_utime.tv_sec + own.ru_stime.tv_sec);
  setrlimit(RLIMIT_CPU, &limit);
  alarm(kMostSecondsOnTheClock);
  armFault(request.fault, request.event, counter);
}

void readNothing() {
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  close(nothing);
}

[[noreturn]] void become(const Request& request, FaultCounter* counter) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  readNothing();
  setUp(request, counter);
  const int code = runProgram(request.words);
  armFault("none", 0, nullptr);
  if (request.exits == "quick") exitQuickly(code);
  std::exit(code);
}

void tell(int code, Usage used, const FaultCounter& counter, long runs_before) {
  std::cout << code << " " << used.cpu_ms << " " << used.memory_kb << " " << counter.events << " "
            << counter.failed_writes << " " << runs_before << "\n"
            << std::flush;
}

/// The end of a child: exit code or minus the signal, and all that it took.
int endOf(pid_t child, Usage& used) {
  int status = 0;
  rusage whole{};
  wait4(child, &status, 0, &whole);
  used = usageOf(whole);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

void answerByFork(const Request& request, FaultCounter* counter) {
  const pid_t child = fork();
  if (child == 0) become(request, counter);
  Usage used;
  const int code = endOf(child, used);
  tell(code, used, *counter, 0);
}

/// A child that runs one request after the other. Where one kills it, the next gets a new child.
class KeptChild {
 public:
  explicit KeptChild(FaultCounter* counter) : counter_(counter) {}
  KeptChild(const KeptChild&) = delete;
  KeptChild& operator=(const KeptChild&) = delete;

  /// Its end must be regular, like each of its previous ends.
  bool end() {
    for (int* descriptor : {&requests_, &answers_, &death_}) {
      if (*descriptor >= 0) close(*descriptor);
      *descriptor = -1;
    }
    Usage used;
    if (child_ > 0 && endOf(child_, used) != 0) ends_are_sound_ = false;
    child_ = -1;
    return ends_are_sound_;
  }

  void answer(const std::string& line) {
    if (child_ < 0) start();
    const std::string request = line + "\n";
    Done done;
    if (write(requests_, request.data(), request.size()) != ssize_t(request.size()) ||
        !readAnswer(done))
      return tellItsEnd();
    tell(done.code, {done.used.cpu_ms - before_.cpu_ms, done.used.memory_kb}, *counter_, runs_++);
    before_ = done.used;
    if (runs_ >= kMostKeptRuns || done.used.memory_kb > kMostKeptKb) end();
  }

 private:
  struct Done {
    int code = 0;
    Usage used;
  };

  void start() {
    std::array<int, 2> requests{}, answers{};
    if (pipe2(requests.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
      std::exit(2);
    child_ = fork();
    if (child_ == 0) {
      close(requests[1]);
      close(answers[0]);
      serve(requests[0], answers[1]);
    }
    close(requests[0]);
    close(answers[1]);
    requests_ = requests[1];
    answers_ = answers[0];
    death_ = static_cast<int>(syscall(SYS_pidfd_open, child_, 0));
    if (death_ < 0) std::exit(2);
    runs_ = 0;
    before_ = {};
  }

  [[noreturn]] void serve(int requests, int answers) const {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    readNothing();
    const int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    FILE* lines = fdopen(requests, "r");
    std::string line;
    for (int c = 0; (c = std::fgetc(lines)) != EOF;) {
      if (c != '\n') {
        line += static_cast<char>(c);
        continue;
      }
      const Done done = runHere(parse(line));
      if (write(answers, &done, sizeof done) != ssize_t(sizeof done)) break;
      line.clear();
    }
    dup2(errors, STDERR_FILENO);
    std::exit(0);  // with static destructors, and a sanitizer's search for leaks of all runs
  }

  Done runHere(const Request& request) const {
    std::cout.clear();
    std::cerr.clear();
    setUp(request, counter_);
    const int code = runProgram(request.words);
    armFault("none", 0, nullptr);
    alarm(0);
    std::cout.flush();
    std::cerr.flush();
    std::fflush(stdout);
    std::fflush(stderr);
    return {code, usageSoFar()};
  }

  /// False where the child has ended: its own children may hold the pipe open still.
  bool readAnswer(Done& done) const {
    pollfd ready[] = {{answers_, POLLIN, 0}, {death_, POLLIN, 0}};
    while (poll(ready, 2, -1) < 0) {
    }
    return (ready[0].revents & POLLIN) != 0 &&
           read(answers_, &done, sizeof done) == ssize_t(sizeof done);
  }

  void tellItsEnd() {
    Usage used;
    const int code = endOf(child_, used);
    tell(code, {used.cpu_ms - before_.cpu_ms, used.memory_kb}, *counter_, runs_);
    child_ = -1;
    end();
  }

  FaultCounter* counter_;
  pid_t child_ = -1;
  int requests_ = -1, answers_ = -1, death_ = -1;
  long runs_ = 0;
  bool ends_are_sound_ = true;
  Usage before_;
};

}  // namespace
}  // namespace softscope::test

int main() {
  using namespace softscope::test;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  unsetenv("DISPLAY");
  auto* counter = static_cast<FaultCounter*>(mmap(
      nullptr, sizeof(FaultCounter), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  signal(SIGPIPE, SIG_IGN);
  KeptChild kept(counter);
  for (std::string line; std::getline(std::cin, line);) {
    const Request request = parse(line);
    *counter = {};
    if (request.exits == "kept")
      kept.answer(line);
    else
      answerByFork(request, counter);
  }
  return kept.end() ? 0 : 1;
}
