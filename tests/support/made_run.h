// tests/support/made_run.h: a moving wall, and a run that is off from it by known lengths.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>

#include "core/point_cloud.h"
#include "support/in_folder.h"

namespace softscope::test {

/// The scope moves right by 1 mm per frame in front of a wall that
/// approaches by 0.5 mm per frame, from 50 mm. Without images:
/// calibration, true meshes, poses, tracks, and optional true depths.
void makeWallTruth(const std::filesystem::path& sequence, int frames, bool with_depth);

/// Files of a run of these frames with a surface 0.1 mm + 0.02 mm per frame too near to the
/// camera where visible, twice as much elsewhere; scope error 0.1 mm per frame downwards;
/// track error 0.5 mm. `first` > 0: the run started there, with its own world frame.
void makeWallRun(const std::filesystem::path& run, int frames, int first = 0);

Eigen::Isometry3d trueWallPose(int frame);  // world_from_left
Eigen::Isometry3d runWallPose(int frame, int first = 0);

/// What makeWallRun writes of one frame, in the run's world.
PointCloud wallModel(int frame, int first = 0);

inline constexpr int kFrames = 6;
inline constexpr double kFloats =
    2e-5;  // floats near 100 mm, and text with 6 digits after the point

/// Both of them, of kFrames frames with true depths, in the folders `truth` and `run`.
class WallTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    makeWallTruth(at("truth"), kFrames, /*with_depth=*/true);
    makeWallRun(at("run"), kFrames);
  }
};

}  // namespace softscope::test
