// toolkit/simulation/simulate_outputs.h: a simulated sequence as a folder.
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

/// Each file appears whole or not at all. Frames first, files about all frames last. Without
/// finish() the destructor takes back what was written.
class SimulateOutputs {
 public:
  /// With `overwrite`, frames of an earlier simulation in the folder are removed. Throws
  /// OptionError where the folder holds anything and `overwrite` is false, or holds something else
  /// than a simulation.
  SimulateOutputs(SimulateOutputOptions options, const std::string& record_json);

  void addFrame(int index, const SimulatedFrame& frame, const std::vector<Triangle>& triangles,
                bool with_truth);

  bool wantsFlow() const { return options_.truth.flow; }

  /// For the frames that were added.
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
  std::vector<VideoWriter> videos_;  // left, right; of images as mp4
  std::string tracks_csv_ = "frame,id,x_mm,y_mm,z_mm,visible\n";
};

/// Three floats a pixel, "PF", lowest row first.
std::string vectorPfm(const Raster<Eigen::Vector3f>& vectors);

/// Middlebury's .flo: two floats a pixel; 1e10 where there is none.
std::string flowBytes(const Raster<Eigen::Vector2f>& flow_px);

/// Binary little-endian PLY, float x y z, in the world frame.
std::string meshPly(const std::vector<Eigen::Vector3f>& vertices_world_mm,
                    const std::vector<Triangle>& triangles);

}  // namespace softscope
