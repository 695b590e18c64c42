#include "toolkit/simulation/layout_folder.h"

#include <algorithm>

#include "core/error.h"
#include "io/text/message.h"

namespace softscope {

namespace fs = std::filesystem;

LayoutFolder::LayoutFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code ignored;
  if (fs::exists(folder_) && !fs::is_directory(folder_))
    throw OptionError("`out=`: " + shown(folder_) + " is a file, but must be a folder");
  if (fs::exists(folder_) && !fs::is_empty(folder_, ignored))
    throw OptionError("`out=`: " + shown(folder_) +
                      " is not empty; with `layout=` choose a new folder");
  files_.makeFolder(folder_);
}

std::vector<VisiblePoint> visiblePoints(const SimulatedFrame& frame, const RectifiedRig& rig) {
  const Eigen::Isometry3d left_from_world = frame.pose.world_from_left.inverse();
  std::vector<VisiblePoint> points;
  for (std::size_t i = 0; i < frame.tracks_world_mm.size(); ++i) {
    const Eigen::Vector3d p = left_from_world * frame.tracks_world_mm[i];
    if (!(p.z() > 0))
      throw InputError(say("tracked point ", i,
                           " is behind the camera; this layout does not support such a clip: use a "
                           "camera path that withdraws less."));
    points.push_back({projectPoint(rig.left, p), rig.disparityPx(p.z()), p.z(),
                      frame.tracks_visible[i], frame.tracks_visible_right[i]});
  }
  return points;
}

ColourImage stackedViews(const StereoPair& pair) {
  ColourImage both(pair.left.width_px, 2 * pair.left.height_px);
  std::copy(pair.left.values.begin(), pair.left.values.end(), both.values.begin());
  std::copy(pair.right.values.begin(), pair.right.values.end(), both.row(pair.left.height_px));
  return both;
}

}  // namespace softscope
