// tests/calibrate/rendered_boards.h: images of a board by cameras that are known.
#pragma once

#include <memory>
#include <vector>

#include "calibrate/view_choice.h"
#include "core/image.h"
#include "core/stereo_rig.h"

namespace softscope::test {

struct ScopeRays;

struct BoardRendering {
  StereoCalibration truth;
  BoardOptions board;
  double blur_px = 0.8;     // sigma
  double noise_levels = 3;  // sigma
  int seed = 1;
  std::shared_ptr<const ScopeRays> rays;  // of `truth`; null: computed where they are needed
};

/// What takes longest, for rendering many sets.
std::shared_ptr<const ScopeRays> raysOfScope(const StereoCalibration& truth);

/// 640 x 480 (times `scale`), f 560 and 563, baseline 4.2 mm, both lenses distorted, the right
/// camera turned by about a degree.
StereoCalibration truthOfScope(double scale = 1);

/// `count` poses: tilted, near and far, over the whole image.
std::vector<Eigen::Isometry3d> boardPoses(const BoardRendering& rendering, int count);

/// One camera's image: 3 x 3 rays a pixel, then blur, then noise.
GrayImage renderBoard(const BoardRendering& rendering, const Eigen::Isometry3d& left_from_board,
                      bool is_right, int noise_seed);

/// Found in the images of all poses, with their order matched; poses whose board is not found in
/// both are left out.
std::vector<BoardSighting> sightBoards(const BoardRendering& rendering, int count);

}  // namespace softscope::test
