#include "io/sequences/timestamps_file.h"

#include <cmath>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr double kLatestS = 1e11;     // 3000 years; seconds since 1970 are 2e9
constexpr double kLongestFrameS = 5;  // on average; above, the unit of time is doubtful

/// "Divide by 1000": for the unit that gives a time since 1970.
std::string unitOf(double time) {
  const double size = std::abs(time);
  if (size < 1e14) return "In milliseconds? Divide by 1000.";
  if (size < 1e17) return "In microseconds? Divide by 1000000.";
  return "In nanoseconds? Divide by 1000000000.";
}

}  // namespace

std::vector<double> parseTimestamps(std::string_view text, const std::string& name) {
  std::vector<double> times_s;
  int line_number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++line_number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const auto time_s = numberOf(content);
    if (!time_s || !std::isfinite(*time_s))
      throw InputError(say(name, ": line ", line_number, " is ", excerpt(content),
                           ", but a time in seconds is expected."));
    if (std::abs(*time_s) > kLatestS)
      throw InputError(say(name, ": line ", line_number, " is ", excerpt(content),
                           ", but a time in seconds is expected. ", unitOf(*time_s)));
    if (!times_s.empty() && *time_s <= times_s.back())
      throw InputError(say(name, ": line ", line_number, " is ", *time_s,
                           " s, which is not later than the line above. Sort it."));
    times_s.push_back(*time_s);
  }
  if (times_s.empty()) throw InputError(name + ": holds no time. Delete it or fill it.");
  return times_s;
}

std::vector<double> readTimestamps(const std::filesystem::path& file) {
  return parseTimestamps(readText(file, kTextLimitBytes), shown(file));
}

std::string timeUnitWarning(const std::vector<double>& times_s) {
  if (times_s.size() < 2) return {};
  const double apart_s = (times_s.back() - times_s.front()) / double(times_s.size() - 1);
  if (apart_s <= kLongestFrameS) return {};
  return say("frames lie ", std::round(10 * apart_s) / 10,
             " s apart. Are the timestamps in milliseconds? Then write seconds");
}

}  // namespace softscope
