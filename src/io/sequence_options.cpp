#include "io/sequence_options.h"

#include <cmath>

#include "core/error.h"
#include "io/message.h"
#include "io/settings_binder.h"
#include "io/text_lines.h"

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
          "sequence.right_offset", right_offset, "must be auto or a whole number of pictures");
  return static_cast<int>(*value);
}

void SequenceOptions::validate() const {
  rightOffset();
  require(read_ahead >= 1 && read_ahead <= 1000, "sequence.read_ahead", read_ahead,
          "must be 1 to 1000");
  require(layout == "auto" || layout == "side-by-side" || layout == "top-bottom" ||
              layout == "interlaced",
          "sequence.layout", layout, "must be auto, side-by-side, top-bottom or interlaced");
  require(frames.begin >= 0, "frames.begin", frames.begin, "can't be negative");
  calibration.validate();
}

void bindSequenceOptions(SettingsBinder& binder, SequenceOptions& options) {
  binder.bind("sequence.layout", options.layout,
              "both views in one picture: auto, side-by-side, top-bottom, interlaced");
  binder.bind("sequence.right_first", options.right_first,
              "in such a picture the right view comes first");
  binder.bind("sequence.right_offset", options.right_offset,
              "right picture f + offset belongs to left picture f: a number, or auto");
  binder.bind("sequence.read_ahead", options.read_ahead, "frames kept ready in memory");
  CalibrationHints& hints = options.calibration;
  binder.bind("calibration.baseline_mm", hints.baseline_mm,
              "distance between the cameras where the file is silent or wrong; 0 = the file's");
  binder.bind("calibration.unit", hints.unit, "of T in the file: mm, cm, m; empty = the file's");
  binder.bind("calibration.rectified", hints.rectified,
              "the pictures are rectified, whatever the file says");
  binder.bind("calibration.image_width_px", hints.image_width_px,
              "where the file is silent; 0 = the pictures'");
  binder.bind("calibration.image_height_px", hints.image_height_px,
              "where the file is silent; 0 = the pictures'");
}

}  // namespace softscope
