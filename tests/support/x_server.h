// tests/support/x_server.h: a screen in memory (Xvfb), for as long as it lives.
#pragma once

#include <string>

namespace softscope::test {

/// Starts Xvfb on a free display and sets DISPLAY; the destructor ends it.
class XServer {
 public:
  XServer();
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  /// Why there is none; empty where there is one.
  const std::string& problem() const { return problem_; }
  const std::string& display() const { return display_; }  // ":1"

 private:
  int process_ = -1;
  std::string problem_, display_;
};

}  // namespace softscope::test
