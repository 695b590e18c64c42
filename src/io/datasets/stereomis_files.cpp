#include "io/datasets/stereomis_files.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/geometry/trajectory_file.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

constexpr double kMostFrames = 1e7;
constexpr double kMmPerM = 1000;
constexpr double kFarthestM = 1;  // from the first place: no scope moves so far in a body

int wholeFrame(double value, const std::string& what) {
  if (!(value >= 0 && value <= kMostFrames) || value != std::floor(value))
    throw InputError(say(what, " is ", value, ", but the number of a frame is expected."));
  return static_cast<int>(value);
}

}  // namespace

std::map<int, Eigen::Isometry3d> parseStereoMisPath(std::string_view text,
                                                    const std::string& name) {
  std::map<int, Eigen::Isometry3d> path;
  for (const TimedPose& pose : parseTrajectory(text, name)) {
    const int frame = wholeFrame(pose.time_s, name + ": the first number of a line");
    if (!path.emplace(frame, pose.world_from_left).second)
      throw InputError(say(name, ": frame ", frame, " comes twice. Download it again."));
  }
  double farthest = 0;
  for (const auto& [frame, pose] : path)
    farthest = std::max(farthest, (pose.translation() - path.begin()->second.translation()).norm());
  if (farthest <= kFarthestM)
    for (auto& [frame, pose] : path) pose.translation() *= kMmPerM;
  return path;
}

std::map<int, Eigen::Isometry3d> readStereoMisPath(const std::filesystem::path& file) {
  return parseStereoMisPath(readBytes(file), shown(file));
}

std::vector<FrameRange> parseStereoMisSplit(std::string_view text, const std::string& name) {
  std::vector<FrameRange> ranges;
  for (const NumberRow& row : numberRows(text)) {
    const std::string what = say(name, ": line ", row.line);
    if (row.values.size() != 2)
      throw InputError(say(what, " has ", row.values.size(),
                           " numbers, but the first and the last frame are expected."));
    FrameRange range;
    range.begin = wholeFrame(row.values[0], what + ": start");
    range.end = wholeFrame(row.values[1], what + ": end");
    if (range.begin >= range.end)
      throw InputError(say(what, ": ", range.begin, " to ", range.end, " holds no frame."));
    ranges.push_back(range);
  }
  if (ranges.empty())
    throw InputError(name + ": holds no range, but lines `start,end` are expected.");
  return ranges;
}

std::vector<FrameRange> readStereoMisSplit(const std::filesystem::path& file) {
  return parseStereoMisSplit(readBytes(file), shown(file));
}

}  // namespace softscope
