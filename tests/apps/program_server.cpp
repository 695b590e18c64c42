// tests/apps/program_server.cpp: a process that waits for command lines and runs them.
#include "tests/apps/program_server.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "apps/program.h"

namespace softscope::test {
namespace {

using Words = std::vector<std::string>;

/// `step` is read() or write(), which may take several calls; false at the end of the pipe.
template <class Step, class Byte>
bool all(const Step& step, int descriptor, Byte* at, std::size_t size) {
  while (size > 0) {
    const ssize_t count = step(descriptor, at, size);
    if (count <= 0) return false;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool readAll(int from, void* data, std::size_t size) {
  return all(read, from, static_cast<char*>(data), size);
}

bool writeAll(int to, const void* data, std::size_t size) {
  return all(write, to, static_cast<const char*>(data), size);
}

bool send(int to, const Words& words) {
  std::string bytes;
  for (const std::string& word : words) bytes += word + '\0';
  const std::uint64_t size = bytes.size();
  return writeAll(to, &size, sizeof size) && writeAll(to, bytes.data(), bytes.size());
}

bool receive(int from, Words& words) {
  std::uint64_t size = 0;
  if (!readAll(from, &size, sizeof size)) return false;
  std::string bytes(size, '\0');
  if (!readAll(from, bytes.data(), bytes.size())) return false;
  words.clear();
  for (std::size_t begin = 0; begin < bytes.size(); begin = bytes.find('\0', begin) + 1)
    words.push_back(bytes.substr(begin, bytes.find('\0', begin) - begin));
  return true;
}

void redirect(int descriptor, const std::string& file) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

/// Files for stdout and stderr and the working folder, then words and environment.
struct Request {
  Words place, words, environment;
};

bool sendRequest(int to, const Request& request) {
  return send(to, request.place) && send(to, request.words) && send(to, request.environment);
}

bool receiveRequest(int from, Request& request) {
  return receive(from, request.place) && receive(from, request.words) &&
         receive(from, request.environment);
}

void setUp(const Request& request) {
  redirect(STDOUT_FILENO, request.place[0]);
  redirect(STDERR_FILENO, request.place[1]);
  if (chdir(request.place[2].c_str()) != 0) _exit(126);
  clearenv();
  for (const std::string& entry : request.environment) {
    const std::string name = entry.substr(0, entry.find('='));
    if (name != "DISPLAY") setenv(name.c_str(), entry.c_str() + name.size() + 1, 1);
  }
}

int runHere(const Request& request) {
  setUp(request);
  std::cout.clear();
  std::cerr.clear();
  const int code = runProgram(request.words);
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
  return W_EXITCODE(code, 0);
}

/// A child that answers requests through two pipes.
struct Child {
  pid_t process = -1;
  int requests = -1, answers = -1;
};

/// `serve(requests, answers)` is what the child does; it does not return.
template <typename Serve>
Child startChild(Serve&& serve) {
  int requests[2], answers[2];
  if (pipe2(requests, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0) _exit(126);
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(requests[1]);
    close(answers[0]);
    serve(requests[0], answers[1]);
  }
  close(requests[0]);
  close(answers[1]);
  return {process, requests[1], answers[0]};
}

/// The status with which a child ends that gets no more requests.
int endOf(Child& child) {
  close(child.requests);
  close(child.answers);
  int status = 0;
  if (child.process > 0) waitpid(child.process, &status, 0);
  child = {};
  return status;
}

[[noreturn]] void runRequests(int requests, int answers) {
  const int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  for (Request request; receiveRequest(requests, request);) {
    const int status = runHere(request);
    if (!writeAll(answers, &status, sizeof status)) break;
  }
  dup2(errors, STDERR_FILENO);
  std::exit(0);  // with static destructors, and a sanitizer's search for leaks of all runs
}

/// Forks the child that runs the requests, and another one where a run has killed it.
[[noreturn]] void keepRunner(int requests, int answers) {
  signal(SIGPIPE, SIG_IGN);  // of a dead runner
  Child runner;
  bool all_ends_are_sound = true;
  for (Request request; receiveRequest(requests, request);) {
    if (runner.process < 0) runner = startChild(runRequests);
    int status = -1;
    if (!sendRequest(runner.requests, request) ||
        !readAll(runner.answers, &status, sizeof status)) {
      status = endOf(runner);
      all_ends_are_sound = false;  // a run returns
    }
    if (!writeAll(answers, &status, sizeof status)) break;
  }
  if (runner.process > 0 && endOf(runner) != 0) all_ends_are_sound = false;
  _exit(all_ends_are_sound ? 0 : 1);
}

class Server : public testing::Environment {
 public:
  void SetUp() override { keeper_ = startChild(keepRunner); }

  void TearDown() override {
    EXPECT_EQ(endOf(keeper_), 0) << "the process that runs softscope did not end well, see above";
  }

  int run(const Words& place, const Words& words) const {
    Request request{place, words, {}};
    for (char** entry = environ; *entry != nullptr; ++entry)
      request.environment.emplace_back(*entry);
    int status = -1;
    const bool done =
        sendRequest(keeper_.requests, request) && readAll(keeper_.answers, &status, sizeof status);
    EXPECT_TRUE(done) << "the process that runs softscope is gone";
    return status;
  }

 private:
  Child keeper_;
};

/// Belongs to the framework, which sets it up before the first test.
Server* const kServer =
    static_cast<Server*>(testing::AddGlobalTestEnvironment(new Server));  // NOLINT

}  // namespace

int runOnServer(const Words& words, const std::filesystem::path& out_file,
                const std::filesystem::path& err_file) {
  return kServer->run(
      {out_file.string(), err_file.string(), std::filesystem::current_path().string()}, words);
}

}  // namespace softscope::test
