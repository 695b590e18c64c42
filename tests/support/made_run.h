// tests/support/made_run.h: a moving wall, and a run that is off from it by known lengths.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>

#include "core/point_cloud.h"
#include "support/in_folder.h"

namespace softscope::test {

/// The scope slides right by 1 mm a frame before a wall that comes nearer by 0.5 mm a frame, from
/// 50 mm. No pictures, for none are needed: calibration, true meshes, poses, tracks, and on wish
/// true depths.
void makeWallTruth(const std::filesystem::path& sequence, int frames, bool with_depth);

/// What a run of these frames would leave if its surface were 0.1 mm + 0.02 mm a frame too near to
/// the camera where that sees it, twice as much elsewhere; its scope off by 0.1 mm a frame
/// downwards; its tracks off by 0.5 mm. `first` > 0: the run began there, with a world of its own.
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
