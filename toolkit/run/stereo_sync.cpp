#include "toolkit/run/stereo_sync.h"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr double kDegPerRad = 180 / 3.14159265358979;
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

struct ViewMeter {
  SynchronyMeter meter;
  PinholeCamera camera;
  std::string bad_views;  // reason of the first frame with them
};

ViewMeter measure(const SequencePaths& paths, const SequenceOptions& options,
                  const StereoOptions& stereo) {
  SequenceOptions successive = options;  // the same frames for every command and range
  successive.frames.end = -1;
  successive.frames.step = 1;
  SequenceReader reader(paths, successive);
  const int step = std::max(1, std::min(reader.frameCount(), kFrames) / kMoments);
  const Rectifier rectifier(reader.calibration());
  const PinholeCamera& camera = rectifier.rig().left;
  ViewMeter views{SynchronyMeter(stereo.forWidth(camera.width_px).disparity_max_px), camera, {}};
  Window window;
  int moments = 0;
  for (int i = 0; i < kFrames; ++i) {
    auto result = reader.next();
    if (!result) break;
    window.push_back(std::move(result->frame.pair));
    if (!result->ok()) window.clear();
    if (result->bad_views && views.bad_views.empty())
      views.bad_views = say("frame ", result->index, ": ", result->error);
    if (window.size() > SynchronyMeter::kOffsets) window.pop_front();
    if (window.size() < SynchronyMeter::kOffsets || i % step != 0) continue;
    addMoment(window, rectifier, views.meter);
    if (++moments == kFirstMoments && views.meter.isClear()) break;
  }
  return views;
}

std::string offsetWarning(const ViewSynchrony& found) {
  std::array<char, 16> offset{};
  std::snprintf(offset.data(), offset.size(), "%+d", found.right_offset);
  return say("the views are not synchronous: right image f ", offset.data(),
             " belongs to left image f (", found.agreeing, " matches have consistent rows then, ",
             found.agreeing_as_is,
             " without the offset) and is paired with it; sequence.right_offset=0 disables this");
}

std::string rowsWarning(const RowDoubt& doubt) {
  return say("the rows of the views do not correspond: of ", doubt.matches, " matches ",
             std::lround(100 * doubt.agreeing_share),
             " % agree on the row differences of all frames, as by chance, or frames differ. Depth "
             "and poses of this clip are not reliable, whatever their confidence. Do images and "
             "calibration belong together? One camera may be turned or zoomed: `softscope "
             "calibrate --refine` measures both");
}

std::string withSign(double value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%+.1f", value);
  return text.data();
}

std::string rollWarning(const RowDoubt& doubt) {
  return say("the right view is rolled by ", withSign(kDegPerRad * doubt.rollRad()),
             " deg against the calibration. Its rows are moved, but depth is better with a "
             "calibration of the cameras as they are: `softscope calibrate --refine`");
}

/// Of a camera turned by a small angle, rows differ by the angle times x y / f.
std::string yawWarning(const RowDoubt& doubt, const PinholeCamera& camera) {
  const double half_width_px = camera.width_px / 2.0;
  const double yaw_rad = doubt.fan_px * camera.fx_px / (half_width_px * half_width_px);
  if (std::abs(yaw_rad) < RowDoubt::kLargestYawRad) return "";
  return say("the rows of the right view fan out as if its camera were turned by ",
             withSign(kDegPerRad * yaw_rad),
             " deg sideways against the calibration: depth is wrong then. Are rotation, lens and "
             "size of the calibration those of these images? Calibrate again if possible");
}

std::string scaleWarning(const RowDoubt& doubt) {
  return say("the right view is scaled by ", withSign(100 * doubt.scale()),
             " % against the left one: the focal lengths of the calibration do not fit, and depth "
             "is wrong towards the sides of the image. Was a camera zoomed or focused since? "
             "Calibrate again");
}

ViewRelation relationAt(const ViewMeter& views, int offset) {
  const RowDoubt doubt = views.meter.doubtAt(offset);
  ViewRelation relation{doubt.rows, {}, views.bad_views};
  if (doubt.is_strong) {
    relation.warnings.push_back(rowsWarning(doubt));
    return relation;
  }
  if (doubt.is_rolled)
    relation.warnings.push_back(rollWarning(doubt));
  else if (doubt.is_scaled)
    relation.warnings.push_back(scaleWarning(doubt));
  const std::string yaw = yawWarning(doubt, views.camera);
  if (!yaw.empty()) relation.warnings.push_back(yaw);
  return relation;
}

}  // namespace

ViewRelation relateViews(const SequencePaths& paths, const FrameDepthOptions& depth,
                         SequenceOptions& options) {
  if (depth.source != "stereo" && !paths.depth.empty()) return {};
  if (paths.right.empty() || isPicture(paths.left)) return {};
  const ViewMeter views = measure(paths, options, depth.stereo);
  if (options.right_offset != "auto") return relationAt(views, 0);
  const ViewSynchrony found = views.meter.result();
  options.right_offset = std::to_string(found.right_offset);
  ViewRelation relation = relationAt(views, found.right_offset);
  if (found.right_offset != 0)
    relation.warnings.insert(relation.warnings.begin(), offsetWarning(found));
  return relation;
}

}  // namespace softscope
