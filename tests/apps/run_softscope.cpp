// tests/apps/run_softscope.cpp: runs, waits, collects.
#include "tests/apps/run_softscope.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "tests/apps/program_server.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

int spawn(const std::vector<std::string>& arguments, const std::string& out,
          const std::string& err) {
  std::string line = "env -u DISPLAY " + quoted(executable());
  for (const std::string& argument : arguments) line += " " + quoted(argument);
  return std::system((line + " >" + quoted(out) + " 2>" + quoted(err)).c_str());
}

/// `study` and `benchmark` run their own file; what `doctor` examines is read as libraries start.
bool wantsItsStart(const std::vector<std::string>& arguments) {
  for (const char* command : {"study", "benchmark", "doctor"})
    if (!arguments.empty() && arguments[0] == command) return true;
  return false;
}

}  // namespace

std::string executable() { return SOFTSCOPE_EXECUTABLE; }

Outcome run(const std::vector<std::string>& arguments) {
  static int count = 0;
  const fs::path base = fs::temp_directory_path() / ("softscope_run_" + std::to_string(getpid()) +
                                                     "_" + std::to_string(count++));
  const std::string out = base.string() + ".out", err = base.string() + ".err";
  const int status =
      wantsItsStart(arguments) ? spawn(arguments, out, err) : runOnServer(arguments, out, err);
  const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(out), textOf(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

}  // namespace softscope::test
