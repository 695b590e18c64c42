// toolkit/run/repeated_warnings.cpp: counts by kind.
#include "toolkit/run/repeated_warnings.h"

namespace softscope {

void RepeatedWarnings::add(const std::string& kind, int frame, const std::string& text) {
  const auto [entry, is_first] = kinds_.try_emplace(kind);
  if (is_first) return tell_("frame " + std::to_string(frame) + ": " + text);
  Repeated& repeated = entry->second;
  if (repeated.count++ == 0) repeated.second = frame;
  repeated.last = frame;
  repeated.last_text = text;
}

void RepeatedWarnings::conclude(const std::string& where) {
  for (const auto& [kind, repeated] : kinds_) {
    if (repeated.count == 0) continue;
    const std::string frames = repeated.count == 1
                                   ? "1 more frame, " + std::to_string(repeated.second)
                                   : std::to_string(repeated.count) + " more frames, " +
                                         std::to_string(repeated.second) + " to " +
                                         std::to_string(repeated.last);
    tell_(kind + ": " + frames + "; " +
          (where.empty() ? "the last: " + repeated.last_text : where));
  }
  kinds_.clear();
}

}  // namespace softscope
