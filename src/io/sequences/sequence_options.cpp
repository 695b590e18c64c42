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
    throw OptionError(say("`frames=` ", excerpt(text),
                          ": A:B or A:B:STEP is expected, frames A up to, not ",
                          "with, B, every STEP-th of them."));
  return static_cast<int>(*value);
}

}  // namespace

FrameRange parseFrameRange(const std::string& text) {
  const std::string_view view = text;
  const std::size_t colon = view.find(':');
  if (colon == std::string::npos) frameOf("?", 0, text);
  const std::string_view rest = view.substr(colon + 1);
  const std::size_t second = rest.find(':');
  FrameRange out;
  out.begin = frameOf(trimmed(view.substr(0, colon)), 0, text);
  out.end = frameOf(trimmed(rest.substr(0, second)), -1, text);
  if (second != std::string_view::npos)
    out.step = frameOf(trimmed(rest.substr(second + 1)), 1, text);
  if (out.step == 0)
    throw OptionError(say("`frames=` ", excerpt(text), ": STEP is 0, but must be 1 or more."));
  if (out.end >= 0 && out.end <= out.begin)
    throw OptionError(say("`frames=` ", excerpt(text), ": names no frame; B must be above A."));
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
  calibration.validate();
  rightOffset();
  require(frames.begin >= 0, "`frames=`", frames.begin, "can't be negative");
  require(frames.step >= 1, "`frames=`", frames.step, "must have a step of 1 or more");
  require(frames.hold_out_every == 0 || frames.hold_out_every >= 2, "`hold_out=`",
          frames.hold_out_every, "must be 2 or more");
  require(frames.hold_out_every == 0 || frames.step == 1, "`hold_out=`", frames.hold_out_every,
          "takes neighbouring frames, `frames=` without a step");
}

}  // namespace softscope
