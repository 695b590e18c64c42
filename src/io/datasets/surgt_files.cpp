#include "io/datasets/surgt_files.h"

#include <cmath>

#include "core/error.h"
#include "io/documents/document.h"
#include "io/documents/number_tree.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

const Document& surgtMember(const Document& map, const char* key, const std::string& name) {
  if (const Document* found = map.find(key)) return *found;
  throw InputError(say(name, ": ", key, " is missing, but SurgT's info.yaml has it."));
}

int sideOf(const Document& size, const char* key, const std::string& name) {
  const std::vector<double> values = numbersOf(surgtMember(size, key, name), say(name, ": ", key));
  if (values.size() != 1 || !(values[0] >= 1 && values[0] <= 16384) ||
      values[0] != std::floor(values[0]))
    throw InputError(say(name, ": ", key, " must be a whole number of 1 to 16384 pixels."));
  return static_cast<int>(values[0]);
}

/// A file in the folder of info.yaml only.
std::string plainName(const std::string& text, const std::string& name) {
  if (!text.empty() && text != "." && text != ".." && text.find('/') == std::string::npos)
    return text;
  throw InputError(say(name, ": names the file ", excerpt(text),
                       ", but the name of a file in the same folder is expected."));
}

bool surgtFlag(const Document& item, const std::string& label) {
  const std::string text = lowerCase(item.text);
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw InputError(say(label, ": ", excerpt(item.text), " is neither true nor false."));
}

bool isNothing(const Document& item) {
  return item.kind == Document::Kind::kText &&
         (item.text.empty() || item.text == "null" || item.text == "~" || item.text == "None");
}

std::array<double, 4> boxOf(const Document& item, const std::string& label) {
  const std::vector<double> values = numbersOf(item, label);
  if (values.size() != 4)
    throw InputError(say(label, ": a box has ", values.size(),
                         " numbers, but u, v, width and height ", "are expected."));
  for (const double value : values)
    if (!std::isfinite(value)) throw InputError(label + ": a box's number is not finite.");
  if (!(values[2] > 0 && values[3] > 0))
    throw InputError(say(label, ": a box of ", values[2], " x ", values[3],
                         " pixels, but both must be above 0."));
  return {values[0], values[1], values[2], values[3]};
}

SurgtFrame frameOf(const Document& item, const std::string& label) {
  if (item.kind != Document::Kind::kList || item.items.size() != 3)
    throw InputError(label + ": is no [visible_in_both, difficult, boxes]. Is it SurgT's file?");
  SurgtFrame frame;
  frame.visible_in_both = surgtFlag(item.items[0], label);
  frame.difficult = surgtFlag(item.items[1], label);
  const Document& boxes = item.items[2];
  if (isNothing(boxes)) {
    if (frame.visible_in_both) throw InputError(label + ": is visible, but has no boxes.");
    return frame;
  }
  if (boxes.kind != Document::Kind::kList || boxes.items.size() != 2)
    throw InputError(label + ": a left and a right box are expected.");
  if (isNothing(boxes.items[0]) || isNothing(boxes.items[1])) {
    if (frame.visible_in_both) throw InputError(label + ": is visible, but lacks a box.");
    return frame;
  }
  frame.boxes = {{boxOf(boxes.items[0], label), boxOf(boxes.items[1], label)}};
  return frame;
}

std::string boxText(const std::array<double, 4>& box) {
  return say("[", exactText(box[0]), ", ", exactText(box[1]), ", ", exactText(box[2]), ", ",
             exactText(box[3]), "]");
}

}  // namespace

SurgtInfo parseSurgtInfo(std::string_view text, const std::string& name) {
  const Document document = parseYaml(text, name);
  SurgtInfo info;
  const std::string stack = lowerCase(surgtMember(document, "video_stack", name).text);
  if (stack != "vertical" && stack != "horizontal")
    throw InputError(say(name, ": video_stack is ", excerpt(stack),
                         ", but vertical or horizontal is expected."));
  info.side_by_side = stack == "horizontal";
  const Document& size = surgtMember(document, "resolution", name);
  info.width_px = sideOf(size, "width", name);
  info.height_px = sideOf(size, "height", name);
  info.video = plainName(surgtMember(document, "name_video", name).text, name);
  if (const Document* truth = document.find("name_ground_truth")) {
    if (truth->kind == Document::Kind::kText && !isNothing(*truth))
      info.truth.push_back(plainName(truth->text, name));
    for (const Document& item : truth->items) info.truth.push_back(plainName(item.text, name));
  }
  return info;
}

SurgtInfo readSurgtInfo(const std::filesystem::path& file) {
  return parseSurgtInfo(readBytes(file), shown(file));
}

std::string surgtInfoYaml(const SurgtInfo& info) {
  std::string text = say("video_stack: ", info.side_by_side ? "horizontal" : "vertical",
                         "\nresolution:\n  width: ", info.width_px, "\n  height: ", info.height_px,
                         "\nname_video: ", info.video, "\nname_ground_truth:\n");
  for (const std::string& file : info.truth) text += say("- ", file, "\n");
  return text;
}

std::vector<SurgtFrame> parseSurgtTruth(std::string_view text, const std::string& name) {
  const Document document = parseYaml(text, name);
  if (document.kind != Document::Kind::kList)
    throw InputError(name + ": holds no list of frames, but SurgT's true boxes are one.");
  std::vector<SurgtFrame> frames;
  for (const Document& item : document.items)
    frames.push_back(frameOf(item, say(name, ": frame ", frames.size())));
  return frames;
}

std::vector<SurgtFrame> readSurgtTruth(const std::filesystem::path& file) {
  return parseSurgtTruth(readBytes(file), shown(file));
}

std::string surgtTruthYaml(const std::vector<SurgtFrame>& frames) {
  std::string text;
  for (const SurgtFrame& frame : frames)
    text += say("- [", frame.visible_in_both ? "true" : "false", ", ",
                frame.difficult ? "true" : "false", ", ",
                frame.boxes
                    ? say("[", boxText((*frame.boxes)[0]), ", ", boxText((*frame.boxes)[1]), "]")
                    : std::string("null"),
                "]\n");
  return text;
}

}  // namespace softscope
