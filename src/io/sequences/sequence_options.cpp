#include "io/sequences/sequence_options.h"

#include <cmath>

#include "core/error.h"
#include "io/sequences/sequence_settings.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

int frameOf(std::string_view word, int otherwise, const std::string& text) {
  if (word.empty()) return otherwise;
  const auto value = numberOf(word);
  if (!value || *value < 0 || *value > 1e9 || *value != std::floor(*value))
    throw OptionError(
        say("--frames ", excerpt(text), ": A:B is expected, frames A up to, not with, B."));
  return static_cast<int>(*value);
}

}  // namespace

FrameRange parseFrameRange(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view view = text;
  if (colon == std::string::npos) frameOf("?", 0, text);
  FrameRange out;
  out.begin = frameOf(trimmed(view.substr(0, colon)), 0, text);
  out.end = frameOf(trimmed(view.substr(colon + 1)), -1, text);
  if (out.end >= 0 && out.end <= out.begin)
    throw OptionError(say("--frames ", excerpt(text), ": names no frame; B must be above A."));
  return out;
}

int SequenceOptions::rightOffset() const {
  if (right_offset == "auto") return 0;
  const auto value = numberOf(right_offset);
  require(value && std::abs(*value) <= 1000 && *value == std::floor(*value),
          "sequence.right_offset", right_offset, "must be auto or a whole number of -1000 to 1000");
  return static_cast<int>(*value);
}

void SequenceOptions::validate() const {
  requireAllowed(*this);
  rightOffset();
  require(frames.begin >= 0, "--frames", frames.begin, "can't be negative");
}

}  // namespace softscope
