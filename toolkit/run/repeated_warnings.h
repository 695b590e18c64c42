// toolkit/run/repeated_warnings.h: one line with a count per kind of warning.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace softscope {

class RepeatedWarnings {
 public:
  explicit RepeatedWarnings(std::function<void(const std::string&)> tell)
      : tell_(std::move(tell)) {}

  /// Reports the first warning of a kind immediately: "frame 4: TEXT"; counts the others.
  void add(const std::string& kind, int frame, const std::string& text);

  /// One line per repeated kind: count and frames. `where`: file with
  /// the full list; without one, the text of the last frame is reported.
  void conclude(const std::string& where);

 private:
  struct Repeated {
    int count = 0, second = 0, last = 0;  // frames that were not reported
    std::string last_text;
  };

  std::function<void(const std::string&)> tell_;
  std::map<std::string, Repeated> kinds_;
};

}  // namespace softscope
