// apps/depth_text.cpp: help, title, range.
#include "apps/depth_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "io/text/text_lines.h"

namespace softscope {

const char* const kDepthDetails =
    "Writes into DIR, for a sequence with the frame's number before each name:\n"
    "  disparity.pfm, disparity.png   px; the png has 16 bits, 256 steps a px, 0 = none\n"
    "  depth.pfm, depth.png           mm along the optical axis; png 16 bits, 0.01 mm a step\n"
    "  confidence.png                 255 x probability that the error is below 0.5 px\n"
    "  cloud.ply                      points with normals and colours, mm\n"
    "  picture.png                    the depth beside the left picture, with its scale\n"
    "  summary.json                   coverage, percentiles, row alignment, times, options\n"
    "Of several frames only depth.png and summary.json are written unless --write asks for more.\n"
    "Rasters are those of the rectified left camera. Raw pairs are rectified first.\n"
    "--write disparity,confidence needs no calibration: two images or folders are then taken to "
    "be\n"
    "rectified.\n"
    "LEFT alone may be a sequence folder, or a picture or video that holds both views\n"
    "(side by side, top and bottom, interlaced). Settings: stereo.*, sequence.*, calibration.*,\n"
    "depth.source, depth.align_rows; a wrong key is answered with the nearest one.";

DepthRange parseDepthRange(const std::string& text) {
  const auto colon = text.find(':');
  const auto low = numberOf(text.substr(0, colon));
  const auto high = colon == std::string::npos ? std::nullopt : numberOf(text.substr(colon + 1));
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || *low >= *high)
    throw OptionError("--range is `" + text +
                      "`, but must be two rising numbers in mm, e.g. 40:80");
  return {*low, *high};
}

DepthRange rangeForAll(const DepthRange& first, bool is_sequence) {
  if (!is_sequence) return first;
  const double margin_mm = std::ceil(0.1 * (first.farthest_mm - first.nearest_mm));
  return {std::max(0.0, first.nearest_mm - margin_mm), first.farthest_mm + margin_mm};
}

std::string titleOf(const std::string& method, const std::string& path, int frame) {
  std::filesystem::path place = std::filesystem::path(path).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();
  std::string title = "Depth by " + method + ": " + place.filename().string();
  if (frame >= 0) title += ", frame " + std::to_string(frame);
  return title;
}

}  // namespace softscope
