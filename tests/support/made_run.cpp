// tests/support/made_run.cpp: closed forms, written as files.
#include "support/made_run.h"

#include <cstdio>
#include <string>

#include "io/calibrations/calibration_writer.h"
#include "io/files/atomic_file.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/ply_writer.h"
#include "io/geometry/trajectory_file.h"
#include "support/in_folder.h"
#include "toolkit/simulation/simulate_outputs.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

constexpr int kTracks = 4;

float wallZ(int frame) { return 50.0f - 0.5f * static_cast<float>(frame); }

std::string numbered(int frame, const char* extension) {
  char name[16];
  std::snprintf(name, sizeof name, "%06d.%s", frame, extension);
  return name;
}

/// Faces the camera, which views along +z.
std::string wallPly(int frame) {
  const float z = wallZ(frame);
  return meshPly({{-90, -90, z}, {90, -90, z}, {90, 90, z}, {-90, 90, z}}, {{0, 2, 1}, {0, 3, 2}});
}

/// Slides with the wall, sideways as well.
Eigen::Vector3d trueTrack(int frame, int id) {
  return {3.0 * id + 0.3 * frame, -2.0 * id, wallZ(frame)};
}

std::string trackLine(int frame, int id, const Eigen::Vector3d& p) {
  char line[128];
  std::snprintf(line, sizeof line, "%d,%d,%.6f,%.6f,%.6f", frame, id, p.x(), p.y(), p.z());
  return line;
}

void writeCalibrationOf(const RectifiedRig& rig, const fs::path& file) {
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = rig.left;
  calibration.right_from_left.translation().x() = -rig.baseline_mm;
  calibration.rectified = true;
  writeCalibration(file, calibration);
}

}  // namespace

Eigen::Isometry3d trueWallPose(int frame) {
  return Eigen::Isometry3d(Eigen::Translation3d(frame, 0, 0));
}

Eigen::Isometry3d runWallPose(int frame, int first) {
  const Eigen::Isometry3d down(Eigen::Translation3d(0, 0.1 * (frame - first), 0));
  return trueWallPose(first).inverse() * trueWallPose(frame) * down;
}

PointCloud wallModel(int frame, int first) {
  const Eigen::Isometry3d run_from_left = runWallPose(frame, first);
  const float error_mm = 0.1f + 0.02f * static_cast<float>(frame);
  const RectifiedRig rig = sequenceRig();
  PointCloud model;
  for (int y = -40; y <= 40; ++y)
    for (int x = -40; x <= 40; ++x) {
      Eigen::Vector3f p(static_cast<float>(x), static_cast<float>(y), wallZ(frame));
      const Eigen::Vector2d pixel = projectPoint<double>(rig.left, p.cast<double>());
      const bool seen =
          pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < 159.5 && pixel.y() < 119.5;
      p.z() -= seen ? error_mm : 2 * error_mm;
      model.points_mm.push_back((run_from_left * p.cast<double>()).cast<float>());
      model.normals.emplace_back(0, 0, -1);
      model.colours.push_back({200, 100, 90});
      model.weights.push_back(3);
    }
  return model;
}

void makeWallTruth(const fs::path& sequence, int frames, bool with_depth) {
  for (const char* folder : {"groundtruth/mesh", "groundtruth/depth"})
    fs::create_directories(sequence / folder);
  writeCalibrationOf(sequenceRig(), sequence / "calibration.yaml");
  Trajectory trajectory;
  std::string tracks = "frame,id,x_mm,y_mm,z_mm\n";
  for (int k = 0; k < frames; ++k) {
    trajectory.push_back({0.04 * k, trueWallPose(k)});
    writeFile(sequence / "groundtruth/mesh" / numbered(k, "ply"), wallPly(k), false);
    if (with_depth)
      writeDepthPng(sequence / "groundtruth/depth" / numbered(k, "png"),
                    Raster<float>(160, 120, wallZ(k)));
    for (int id = 0; id < kTracks; ++id) tracks += trackLine(k, id, trueTrack(k, id)) + "\n";
  }
  writeTrajectory(sequence / "groundtruth/trajectory.txt", trajectory);
  writeFile(sequence / "groundtruth/tracks.csv", tracks, false);
}

void makeWallRun(const fs::path& run, int frames, int first) {
  fs::create_directories(run / "models");
  Trajectory trajectory;
  std::string tracks = "frame,id,x_mm,y_mm,z_mm,visible\n", table = "frame,time_s,status,reason\n";
  for (int k = first; k < frames; ++k) {
    trajectory.push_back({0.04 * k, runWallPose(k, first)});
    table += std::to_string(k) + ",,fused,\"a, b\"\n";
    writePly(run / "models" / numbered(k, "ply"), wallModel(k, first), {"world", ""});
    const Eigen::Isometry3d run_from_true = runWallPose(k, first) * trueWallPose(k).inverse();
    for (int id = 0; id < kTracks; ++id)
      tracks +=
          trackLine(k, id, run_from_true * (trueTrack(k, id) + Eigen::Vector3d(0.3, 0, 0.4))) +
          (id == 0 ? ",0\n" : ",1\n");
  }
  fs::copy_file(run / "models" / numbered(frames - 1, "ply"), run / "model.ply");
  writeTrajectory(run / "trajectory.txt", trajectory);
  writeFile(run / "frames.csv", table, false);
  writeFile(run / "tracks.csv", tracks, false);
}

}  // namespace softscope::test
