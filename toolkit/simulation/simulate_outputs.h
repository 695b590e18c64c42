// toolkit/simulation/simulate_outputs.h: writer of a simulated sequence folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/trajectory.h"
#include "eval/simulation/sequence/simulator.h"
#include "io/files/new_files.h"
#include "io/images/video_writer.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

struct SimulateOutputOptions {
  std::filesystem::path folder;
  TruthKinds truth;
  std::string pictures = "png";
  double frames_per_second = 25;  // of mp4
  int jpeg_quality = 95;
  bool masks = true;
  bool input_depth = false;
  bool overwrite = false;
};

/// Files are written atomically: per frame first, then those of
/// all frames. Without finish() the destructor removes them.
class SimulateOutputs {
 public:
  /// With `overwrite`, frames of an earlier simulation are removed. Throws
  /// OptionError for a folder that is not empty without `overwrite`, or
  /// that contains other files than those of a simulation.
  SimulateOutputs(SimulateOutputOptions options, const std::string& record_json);

  void addFrame(int index, const SimulatedFrame& frame, const std::vector<Triangle>& triangles,
                bool with_truth);

  bool wantsFlow() const { return options_.truth.flow; }

  /// Completes the sequence after the last frame.
  void finish(const Simulator& simulator);

 private:
  std::filesystem::path numbered(const char* folder, int index, const std::string& end) const;
  void writePictures(int index, const StereoPair& pair);
  void writePicture(const char* folder, int index, const ColourImage& picture) const;
  void addToVideos(const StereoPair& pair);
  void writeTruth(int index, const SimulatedFrame& frame,
                  const std::vector<Triangle>& triangles) const;
  void addTracks(int index, const SimulatedFrame& frame);

  void writeDepth(const char* folder, int index, const Raster<float>& depth_mm) const;
  template <class Write>
  void make(const std::filesystem::path& file, const Write& write) const {
    new_files_.make(file, [&] { write(file); });
  }

  SimulateOutputOptions options_;
  mutable NewFiles new_files_;
  Trajectory trajectory_;
  std::vector<VideoWriter> videos_;  // left, right; for images as mp4
  std::string tracks_csv_ = "frame,id,x_mm,y_mm,z_mm,visible\n";
};

/// Three floats per pixel, "PF", lowest row first.
std::string vectorPfm(const Raster<Eigen::Vector3f>& vectors);

/// Middlebury .flo: two floats per pixel; 1e10 for unknown flow.
std::string flowBytes(const Raster<Eigen::Vector2f>& flow_px);

/// Binary little-endian PLY, float x y z, in the world frame.
std::string meshPly(const std::vector<Eigen::Vector3f>& vertices_world_mm,
                    const std::vector<Triangle>& triangles);

}  // namespace softscope
