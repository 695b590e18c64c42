#include "toolkit/run/stereo_sync.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>

#include "io/sequences/sequence_reader.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "stereo/rectification/view_synchrony.h"

namespace softscope {
namespace {

constexpr int kFrames = 120;  // length of the search; tissue moves by breathing within some seconds
constexpr int kMoments = 12;  // compared times within the search
constexpr int kFirstMoments = 3;  // after which the answer may be clear
constexpr std::size_t kReach = SynchronyMeter::kReach;

/// Consecutive pairs; the left image of the middle one is compared with all right images.
using Window = std::deque<StereoPair>;

void addMoment(const Window& window, const Rectifier& rectifier, SynchronyMeter& meter) {
  std::array<GrayImage, SynchronyMeter::kOffsets> rights;
  GrayImage left;
  for (std::size_t k = 0; k < rights.size(); ++k) {
    const StereoPair pair = rectifier.rectify(window[k]);
    rights[k] = toGray(pair.right);
    if (k == kReach) left = toGray(pair.left);
  }
  meter.add(left, rights);
}

SynchronyMeter measure(const SequencePaths& paths, const SequenceOptions& options,
                       const StereoOptions& stereo) {
  SequenceOptions successive = options;  // the same frames for every command and range
  successive.frames.end = -1;
  successive.frames.step = 1;
  SequenceReader reader(paths, successive);
  const int step = std::max(1, std::min(reader.frameCount(), kFrames) / kMoments);
  const Rectifier rectifier(reader.calibration());
  SynchronyMeter meter(stereo.forWidth(rectifier.rig().left.width_px).disparity_max_px);
  Window window;
  int moments = 0;
  for (int i = 0; i < kFrames; ++i) {
    auto result = reader.next();
    if (!result) break;
    window.push_back(std::move(result->frame.pair));
    if (!result->ok()) window.clear();
    if (window.size() > SynchronyMeter::kOffsets) window.pop_front();
    if (window.size() < SynchronyMeter::kOffsets || i % step != 0) continue;
    addMoment(window, rectifier, meter);
    if (++moments == kFirstMoments && meter.isClear()) break;
  }
  return meter;
}

std::string warningOf(const ViewSynchrony& found) {
  if (found.right_offset == 0) return "";
  std::array<char, 16> offset{};
  std::snprintf(offset.data(), offset.size(), "%+d", found.right_offset);
  return say("the views are not synchronous: right image f ", offset.data(),
             " belongs to left image f (", found.agreeing, " matches have consistent rows then, ",
             found.agreeing_as_is,
             " without the offset) and is paired with it; sequence.right_offset=0 disables this");
}

}  // namespace

ViewRelation relateViews(const SequencePaths& paths, const FrameDepthOptions& depth,
                         SequenceOptions& options) {
  if (depth.source != "stereo" && !paths.depth.empty()) return {};
  if (paths.right.empty() || isPicture(paths.left)) return {};
  const SynchronyMeter meter = measure(paths, options, depth.stereo);
  if (options.right_offset != "auto") return {meter.rowsAt(0), ""};
  const ViewSynchrony found = meter.result();
  options.right_offset = std::to_string(found.right_offset);
  return {meter.rowsAt(found.right_offset), warningOf(found)};
}

}  // namespace softscope
