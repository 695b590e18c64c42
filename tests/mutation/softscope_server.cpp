// tests/mutation/softscope_server.cpp: softscope's commands in a process that forks for each, so
// that a run costs no loading of libraries.
//
// A request is a line of stdin, its fields separated by U+001F: folder to run in, file for stdout
// (`pipe`: a pipe without a reader; `closed`: none), file for stderr (the same), seconds of
// processor time, kind of fault, its event, way to exit (`whole`: with static destructors; `quick`:
// streams are flushed alone), words of the command line. The answer is a line of stdout: exit code
// or minus the signal, milliseconds of processor time, largest memory in KB, counted events, writes
// that failed for a full disk.
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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

struct Request {
  std::string folder, out, err;
  long seconds = 0;
  std::string fault;
  long event = 0;
  bool exits_whole = true;
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
  return {fields[0],
          fields[1],
          fields[2],
          std::atol(fields[3].c_str()),
          fields[4],
          std::atol(fields[5].c_str()),
          fields[6] != "quick",
          {fields.begin() + 7, fields.end()}};
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

[[noreturn]] void become(const Request& request, FaultCounter* counter) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (chdir(request.folder.c_str()) != 0) _exit(126);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  close(nothing);
  redirect(STDOUT_FILENO, request.out);
  redirect(STDERR_FILENO, request.err);
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = static_cast<rlim_t>(request.seconds);
  setrlimit(RLIMIT_CPU, &limit);
  alarm(kMostSecondsOnTheClock);
  armFault(request.fault, request.event, counter);
  const int code = runProgram(request.words);
  armFault("none", 0, nullptr);
  if (!request.exits_whole) exitQuickly(code);
  std::exit(code);
}

void answer(const Request& request, FaultCounter* counter) {
  *counter = {};
  const pid_t child = fork();
  if (child == 0) become(request, counter);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  const long cpu_ms = (used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1000 +
                      (used.ru_utime.tv_usec + used.ru_stime.tv_usec) / 1000;
  const int code = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  std::cout << code << " " << cpu_ms << " " << used.ru_maxrss << " " << counter->events << " "
            << counter->failed_writes << "\n"
            << std::flush;
}

}  // namespace
}  // namespace softscope::test

int main() {
  using namespace softscope::test;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  unsetenv("DISPLAY");
  auto* counter = static_cast<FaultCounter*>(mmap(
      nullptr, sizeof(FaultCounter), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (std::string line; std::getline(std::cin, line);) answer(parse(line), counter);
}
