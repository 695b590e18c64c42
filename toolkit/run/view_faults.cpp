#include "toolkit/run/view_faults.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "eval/statistics/statistics.h"
#include "io/files/folder.h"
#include "io/images/orientation_tag.h"
#include "io/text/message.h"
#include "stereo/options/stereo_options.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {
namespace {

constexpr double kMostMasked = 0.95;     // share of the image
constexpr double kUnevenViews = 0.6;     // brightness of one view in that of the other
constexpr double kNearlyBlackMean = 4;   // of 255
constexpr int kNearlyBlackLargest = 16;  // 4095 / 65535 * 255: 12 bits of data in 16

struct ViewBrightness {
  double mean = 0;
  int largest = 0;
  bool isDark() const { return mean < kNearlyBlackMean || largest <= kNearlyBlackLargest; }
};

ViewBrightness viewBrightness(const GrayImage& image) {
  const double sum = std::accumulate(image.values.begin(), image.values.end(), 0.0);
  return {sum / static_cast<double>(image.size()),
          *std::max_element(image.values.begin(), image.values.end())};
}

/// "mean 1.2, largest value 4 of 255".
std::string textOf(const ViewBrightness& view) {
  return "mean " + fixed(view.mean, 1) + ", largest value " + std::to_string(view.largest) +
         " of 255";
}

std::string brightnessFault(const StereoPair& pair) {
  const ViewBrightness left = viewBrightness(toGray(pair.left));
  const ViewBrightness right = viewBrightness(toGray(pair.right));
  if (left.isDark() && right.isDark())
    return say("the images are black: ", textOf(left),
               left.largest > 0 && left.largest <= kNearlyBlackLargest
                   ? " (16-bit files must use all 16 bits: scale 10- or 12-bit data)"
                   : "");
  if (left.isDark() || right.isDark())
    return say("the ", left.isDark() ? "left" : "right",
               " image is black: ", textOf(left.isDark() ? left : right));
  const bool right_darker = right.mean < left.mean;
  const double share = right_darker ? right.mean / left.mean : left.mean / right.mean;
  if (share >= kUnevenViews) return {};
  return say("the ", right_darker ? "right" : "left", " image has ", fixed(100 * share, 0),
             " % of the brightness of the ", right_darker ? "left" : "right", " one");
}

bool viewsMatch(const Rectifier& rectifier, const StereoPair& raw) {
  const StereoPair rectified = rectifier.rectify(raw);
  return measureRowAlignment(toGray(rectified.left), toGray(rectified.right),
                             StereoOptions().forWidth(rectified.left.width_px).disparity_max_px)
      .known();
}

std::string orderFault(const StereoPair& pair, const ViewOrigin& source) {
  const Rectifier rectifier(source.calibration);
  if (viewsMatch(rectifier, pair) || !viewsMatch(rectifier, {pair.right, pair.left})) return {};
  const std::string remedy =
      source.paths.stereo.empty()
          ? "give the views in the other order"
          : say("set sequence.right_first=", source.right_first ? "false" : "true");
  return "the views match when exchanged: " + remedy +
         "; images that are mirrored or rotated by 180 degrees match so, too";
}

std::string orientationFault(const FrameNames& names, const SequencePaths& paths) {
  const std::filesystem::path& view = paths.stereo.empty() ? paths.left : paths.stereo;
  const std::filesystem::path file = isFolder(view) ? view / names.left : view;
  if (!isPicture(file)) return {};
  const int tag = orientationTag(file);
  if (tag == 1) return {};
  return say(shown(file), " has the orientation tag ", tag,
             ", which is ignored: store the pixels as the calibration has them");
}

bool hasTwoViews(const Frame& frame) {
  return !frame.pair.left.empty() && !frame.pair.right.empty() && frame.depth_mm.empty();
}

std::string joined(const std::vector<std::string>& faults) {
  std::string all;
  for (const std::string& fault : faults)
    if (!fault.empty()) all += (all.empty() ? "" : "; ") + fault;
  return all;
}

}  // namespace

std::string maskFault(const Mask& mask) {
  if (mask.empty()) return {};
  const auto hidden = std::count_if(mask.values.begin(), mask.values.end(),
                                    [](std::uint8_t value) { return value != 0; });
  const double share = static_cast<double>(hidden) / static_cast<double>(mask.size());
  if (share < kMostMasked) return {};
  return "the mask hides " + fixed(100 * share, 0) +
         " % of the image: non-zero pixels are ignored; is it inverted?";
}

std::string frameFaults(const Frame& frame) {
  if (!hasTwoViews(frame)) return {};
  return joined({maskFault(frame.mask), brightnessFault(frame.pair)});
}

std::string viewFaults(const Frame& frame, const FrameNames& names, const ViewOrigin& source) {
  if (!hasTwoViews(frame)) return {};
  return joined(
      {frameFaults(frame), orderFault(frame.pair, source), orientationFault(names, source.paths)});
}

}  // namespace softscope
