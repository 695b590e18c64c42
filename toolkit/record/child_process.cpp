// toolkit/record/child_process.cpp: fork, exec, wait.
#include "toolkit/record/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr int kCannotStart = 127;  // as in shells

int codeOf(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

/// In the child: nothing here may allocate or throw.
[[noreturn]] void become(char* const* words, char* const* environment, int log, int parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kCannotStart);  // the parent ended before the request
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execve(words[0], words, environment);
  _exit(kCannotStart);
}

/// In the form that exec requires: ends with null, valid as long as `words`.
std::vector<char*> pointersTo(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// This process's environment with `variables` in it.
std::vector<std::string> environmentWith(const std::vector<std::string>& variables) {
  std::vector<std::string> all = variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool replaced =
        std::any_of(variables.begin(), variables.end(),
                    [&](const std::string& other) { return other.rfind(name, 0) == 0; });
    if (!replaced) all.push_back(text);
  }
  return all;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const fs::path& log,
                           const std::vector<std::string>& variables) {
  const std::vector<char*> pointers = pointersTo(words);
  const std::vector<std::string> entries = environmentWith(variables);
  const std::vector<char*> environment = pointersTo(entries);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) throw Error(shown(log) + ": can't be written to; check the rights of its folder");
  signal(SIGCHLD, SIG_DFL);  // ignored, as some parents set it, waiting fails
  const int parent = getpid();
  id_ = fork();
  if (id_ == 0) become(pointers.data(), environment.data(), file, parent);
  close(file);
  if (id_ < 0) throw Error("no further process can be started; fewer `jobs=` need fewer");
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), exit_code_(other.exit_code_) {}

ChildProcess::~ChildProcess() {
  int status = 0;
  while (id_ > 0 && waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> ChildProcess::ended() {
  int status = 0;
  if (id_ <= 0) return exit_code_;
  const int found = waitpid(id_, &status, WNOHANG);
  if (found == id_) exit_code_ = codeOf(status);
  if (found < 0 && errno != EINTR) exit_code_ = kCannotStart;  // waited for elsewhere
  if (exit_code_) id_ = -1;
  return exit_code_;
}

void ChildProcess::interrupt() {
  if (id_ > 0) kill(id_, SIGINT);
}

fs::path executablePath() { return fs::read_symlink("/proc/self/exe"); }

void sleepBriefly() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

}  // namespace softscope
