// toolkit/run/repeated_warnings.h: warnings of many frames, one line per kind and its count.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace softscope {

class RepeatedWarnings {
 public:
  explicit RepeatedWarnings(std::function<void(const std::string&)> tell)
      : tell_(std::move(tell)) {}

  /// Tells the first warning of a kind at once: "frame 4: TEXT"; counts the others.
  void add(const std::string& kind, int frame, const std::string& text);

  /// A line per kind that came again: how often, and in which frames. `where` says what lists them
  /// all.
  void conclude(const std::string& where);

 private:
  struct Repeated {
    int count = 0, second = 0, last = 0;  // the frames that were not told
  };

  std::function<void(const std::string&)> tell_;
  std::map<std::string, Repeated> kinds_;
};

}  // namespace softscope
