// apps/program.cpp: execution of a command, and exit codes of failures.
#include "apps/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "apps/command_line.h"
#include "apps/exit_codes.h"
#include "apps/log.h"
#include "core/error.h"
#include "core/parallel.h"
#include "io/images/quiet_libraries.h"
#include "io/text/message.h"

namespace softscope {
namespace {

int runCommand(Command& command) {
  setUpLog(command.common);
  const ThreadLimit limit(command.common.threads);
  return command.run();
}

/// Throws if the output was not written: full disk, closed pipe.
void requirePrinted() {
  if (!std::cout.flush())
    throw Error("the output can't be written: is the disk full, or the pipe closed?");
}

int runLine(const std::vector<std::string>& words) {
  const auto commands = allCommands();
  const ParsedLine line = parseCommandLine(words, commands);
  std::cout << line.text;
  const int code = line.command == nullptr ? kDone : runCommand(*line.command);
  requirePrinted();
  return code;
}

/// File, reason of the system, advice: the structure of our own errors.
std::string messageOf(const std::filesystem::filesystem_error& error) {
  return say(shown(error.path1()), ": ", error.code().message(),
             ". Check the path and the rights of its folders.");
}

/// With a closed stdin, stdout or stderr, the next opened file would get its
/// number and receive its output. A pipe without a reader becomes a write error,
/// and so does a file at the limit of its size.
void secureStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", O_RDWR);  // lowest free number
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

int runProgram(const std::vector<std::string>& words) {
  secureStreams();
  quietLibraries();
  setUpLog({});
  try {
    return runLine(words);
  } catch (const OptionError& error) {
    spdlog::error("{}", error.what());
    return kUsage;
  } catch (const BackendError& error) {
    spdlog::error("{}", error.what());
    return kNoBackend;
  } catch (const Error& error) {  // InputError, and write errors
    spdlog::error("{}", error.what());
    return kInput;
  } catch (const std::filesystem::filesystem_error& error) {
    spdlog::error("{}", messageOf(error));
    return kInput;
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory. Use smaller images or fewer threads");
    return kBug;
  } catch (const std::exception& error) {
    spdlog::error("unexpected: {}. Please report this with the command line", error.what());
    return kBug;
  }
}

}  // namespace softscope
