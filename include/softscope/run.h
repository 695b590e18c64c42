// include/softscope/run.h: the folder that a reconstruction leaves.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// N points in the world frame, which is the left camera at the first frame.
struct Model {
  std::vector<float> points_mm;       // N x 3
  std::vector<float> normals;         // N x 3, unit length, out of the tissue
  std::vector<std::uint8_t> colours;  // N x 3: red, green, blue
  std::vector<float> weights;         // N: how often, and how well, each point was seen
  std::vector<float> sigmas_mm;       // N: predicted standard errors; NaN where unknown, empty of
                                      // a run that has none

  std::size_t size() const { return weights.size(); }
};

/// 4 x 4, row by row: p_world = world_from_left * p_left, mm.
using Pose = std::array<double, 16>;

class Run {
 public:
  /// Throws InputError where the folder holds no run.
  explicit Run(std::string folder);

  const std::string& folder() const { return folder_; }
  /// Of each frame that has a pose, rising; poses() has their order.
  const std::vector<int>& frames() const { return frames_; }
  const std::vector<Pose>& poses() const { return poses_; }
  /// Frames whose model was saved.
  const std::vector<int>& savedModels() const { return saved_; }
  /// The last model, or the one that was saved at `frame`. Throws InputError.
  Model model() const;
  Model model(int frame) const;

 private:
  std::string folder_;
  std::vector<int> frames_, saved_;
  std::vector<Pose> poses_;
};

}  // namespace softscope::api
