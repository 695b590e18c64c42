// toolkit/simulation/layout_folder.h: common parts of all
// layouts: output folder, projection of points into both cameras.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/simulation/sequence/simulator.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"

namespace softscope {

/// New or empty output folder; its files are removed without keep().
class LayoutFolder {
 public:
  /// Throws OptionError.
  explicit LayoutFolder(std::filesystem::path folder);

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  /// Calls `write(file)` after creation of the folders of `name`.
  template <class Write>
  void make(const std::string& name, const Write& write) {
    const std::filesystem::path file = folder_ / name;
    files_.makeFolder(file.parent_path());
    files_.make(file, [&] { write(file); });
  }
  void put(const std::string& name, const std::string& bytes) {
    make(name, [&](const std::filesystem::path& file) { writeFile(file, bytes, false); });
  }
  void makeFolder(const std::string& name) { files_.makeFolder(folder_ / name); }
  void keep() { files_.keep(); }

 private:
  std::filesystem::path folder_;
  NewFiles files_;
};

/// Tracked point in both rectified images.
struct VisiblePoint {
  Eigen::Vector2d left_px;
  double disparity_px = 0;
  double depth_mm = 0;
  bool in_left = false, in_right = false;
};

/// Throws InputError for a point behind the camera.
std::vector<VisiblePoint> visiblePoints(const SimulatedFrame& frame, const RectifiedRig& rig);

/// Left image above the right one.
ColourImage stackedViews(const StereoPair& pair);

}  // namespace softscope
