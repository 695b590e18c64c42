// tests/apps/forked_program.cpp: a process that waits for lines and forks for each.
#include "tests/apps/forked_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>

#include "apps/program.h"

namespace softscope::test {
namespace {

using Words = std::vector<std::string>;

bool readAll(int from, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = read(from, at, size);
    if (count <= 0) return false;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool writeAll(int to, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = write(to, at, size);
    if (count <= 0) return false;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
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

/// The request: files for stdout and stderr, the working folder, then words and environment.
[[noreturn]] void become(const Words& place, const Words& words, const Words& environment) {
  redirect(STDOUT_FILENO, place[0]);
  redirect(STDERR_FILENO, place[1]);
  if (chdir(place[2].c_str()) != 0) _exit(126);
  clearenv();
  for (const std::string& entry : environment) {
    const std::string name = entry.substr(0, entry.find('='));
    if (name != "DISPLAY") setenv(name.c_str(), entry.c_str() + name.size() + 1, 1);
  }
  std::exit(runProgram(words));
}

[[noreturn]] void serve(int requests, int answers) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  Words place, words, environment;
  while (receive(requests, place) && receive(requests, words) && receive(requests, environment)) {
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      close(requests);
      close(answers);
      become(place, words, environment);
    }
    int status = -1;
    waitpid(child, &status, 0);
    if (!writeAll(answers, &status, sizeof status)) break;
  }
  _exit(0);
}

class Server : public testing::Environment {
 public:
  void SetUp() override {
    int requests[2], answers[2];
    if (pipe2(requests, O_CLOEXEC) != 0 || pipe2(answers, O_CLOEXEC) != 0) return;
    process_ = fork();
    if (process_ == 0) {
      close(requests[1]);
      close(answers[0]);
      serve(requests[0], answers[1]);
    }
    close(requests[0]);
    close(answers[1]);
    requests_ = requests[1];
    answers_ = answers[0];
  }

  void TearDown() override {
    close(requests_);
    close(answers_);
    waitpid(process_, nullptr, 0);
  }

  int run(const Words& place, const Words& words) const {
    Words environment;
    for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
    int status = -1;
    const bool done = send(requests_, place) && send(requests_, words) &&
                      send(requests_, environment) && readAll(answers_, &status, sizeof status);
    EXPECT_TRUE(done) << "the process that runs softscope is gone";
    return status;
  }

 private:
  pid_t process_ = -1;
  int requests_ = -1, answers_ = -1;
};

/// Belongs to the framework, which sets it up before the first test.
Server* const kServer =
    static_cast<Server*>(testing::AddGlobalTestEnvironment(new Server));  // NOLINT

}  // namespace

int runForked(const Words& words, const std::filesystem::path& out_file,
              const std::filesystem::path& err_file) {
  return kServer->run(
      {out_file.string(), err_file.string(), std::filesystem::current_path().string()}, words);
}

}  // namespace softscope::test
