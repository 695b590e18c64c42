// toolkit/depth/depth_outputs.h: output files of `softscope depth`, per frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "io/files/new_files.h"
#include "toolkit/depth/depth_estimator.h"
#include "vtk_views/plots/depth_picture.h"

namespace softscope {

/// Selection of output files.
struct DepthOutputKinds {
  bool disparity = true, depth = true, confidence = true, cloud = true, picture = true;
  bool floats = true;  // also disparity and depth as PFM
  bool dense = false;  // depth and its standard error for every pixel, measured or filled

  /// Default for several frames: depth.png only. All kinds
  /// take about 10 MB per frame of 640 x 480 pixels.
  static DepthOutputKinds ofSequence() { return {false, true, false, false, false, false, false}; }

  /// True if no output is in mm: no calibration is needed.
  bool onlyPixels() const { return !depth && !cloud && !picture && !dense; }

  /// "depth,picture"; empty = all but dense. Throws OptionError with the nearest name.
  static DepthOutputKinds parse(const std::string& list);
};

struct DepthOutputOptions {
  std::filesystem::path folder;
  DepthOutputKinds kinds;
  bool overwrite = false;
  bool raw_left = false;  // camera frame in the header of the point cloud
};

/// Without keep() the destructor removes the written files.
class DepthOutputs {
 public:
  explicit DepthOutputs(DepthOutputOptions options) : options_(std::move(options)) {}

  /// Throws OptionError with the first existing file, unless overwriting is allowed.
  void requireFree(const std::vector<std::string>& prefixes) const;

  /// Files <prefix>depth.png and so on, written atomically.
  void write(const std::string& prefix, const DepthResult& measured, const DepthRange& range,
             const std::string& title) const;

  /// Description of the output for the user: the folder, then the files of `frames` frames.
  std::vector<std::string> writtenFiles(int frames) const;

  void writeSummary(const std::string& json) const;
  void keep() const { new_files_.keep(); }

 private:
  std::vector<std::string> names() const;
  std::filesystem::path summaryFile() const { return options_.folder / "summary.json"; }
  template <class Write>
  void make(const std::string& prefix, const char* name, const Write& write) const {
    const std::filesystem::path path = file(prefix, name);
    new_files_.make(path, [&] { write(path); });
  }
  std::filesystem::path file(const std::string& prefix, const char* name) const {
    return options_.folder / (prefix + name);
  }
  DepthOutputOptions options_;
  mutable NewFiles new_files_;
};

/// 255 times the probability of an error below half a pixel, for a normal
/// distribution with the predicted standard error; 0 for unmeasured pixels.
GrayImage confidenceImage(const DisparityMap& disparity);

}  // namespace softscope
