// tests/support/x_server.cpp: Xvfb writes the number of its display to a pipe.
#include "support/x_server.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace softscope::test {

XServer::XServer() {
  int ends[2];
  if (pipe(ends) != 0) {
    problem_ = "no pipe";
    return;
  }
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    const std::string number = std::to_string(ends[1]);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // not left behind by a test that crashes
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "800x640x24", "-nolisten",
           "tcp", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  char letter = 0;
  while (read(ends[0], &letter, 1) == 1 && letter != '\n') display_ += letter;
  close(ends[0]);
  if (display_.empty()) {
    problem_ = "Xvfb is not installed, or doesn't start";
    return;
  }
  display_ = ":" + display_;
  setenv("DISPLAY", display_.c_str(), 1);
}

XServer::~XServer() {
  unsetenv("DISPLAY");
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

}  // namespace softscope::test
