// toolkit/record/child_process.h: `softscope` as a child process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace softscope {

/// A program in a process group of its own: Ctrl-C reaches it by
/// interrupt() only. It receives a request to end when this process ends.
class ChildProcess {
 public:
  /// `words[0]` is the program. Its output and errors are appended to `log`. `variables`
  /// ("NAME=value") replace those of this process's environment. Throws Error where it can't be
  /// started.
  ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& log,
               const std::vector<std::string>& variables = {});
  ~ChildProcess();  // waits for its end
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Its exit code once it has ended (128 + the signal, if any); never waits.
  std::optional<int> ended();
  /// Requests a clean end.
  void interrupt();

 private:
  int id_ = -1;  // -1: ended
  std::optional<int> exit_code_;
};

/// Waits for its end; passes on an interrupt that `interrupted` reports.
template <class Interrupted>
int runToEnd(ChildProcess child, const Interrupted& interrupted);

/// Path of the running program.
std::filesystem::path executablePath();

/// Sleeps between two polls of the child processes.
void sleepBriefly();

template <class Interrupted>
int runToEnd(ChildProcess child, const Interrupted& interrupted) {
  bool told = false;
  for (;;) {
    if (const auto code = child.ended()) return *code;
    if (!told && interrupted()) {
      child.interrupt();
      told = true;
    }
    sleepBriefly();
  }
}

}  // namespace softscope
