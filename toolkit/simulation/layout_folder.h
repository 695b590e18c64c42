// toolkit/simulation/layout_folder.h: what the layouts of data sets share: their folder, points as
// both cameras see them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/simulation/sequence/simulator.h"
#include "io/files/atomic_file.h"
#include "io/files/new_files.h"

namespace softscope {

/// The folder, which must be new or empty, and what is written into it; taken back without keep().
class LayoutFolder {
 public:
  /// Throws OptionError.
  explicit LayoutFolder(std::filesystem::path folder);

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  /// Calls `write(file)`; makes the folders of `name` first.
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

/// A tracked point in both rectified images.
struct SeenPoint {
  Eigen::Vector2d left_px;
  double disparity_px = 0;
  double depth_mm = 0;
  bool in_left = false, in_right = false;
};

/// Throws InputError where one lies behind the camera.
std::vector<SeenPoint> seenPoints(const SimulatedFrame& frame, const RectifiedRig& rig);

/// Left above right.
ColourImage stackedViews(const StereoPair& pair);

}  // namespace softscope
