// toolkit/simulation/simulate_outputs.cpp: images, calibration and ground truth.
#include "toolkit/simulation/simulate_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "core/parallel.h"
#include "io/calibrations/calibration_writer.h"
#include "io/files/atomic_file.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/trajectory_file.h"
#include "io/images/image_writer.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "simulation.json";
constexpr const char* kFrameFolders[] = {"left",
                                         "right",
                                         "depth",
                                         "mask",
                                         "groundtruth/depth",
                                         "groundtruth/mesh",
                                         "groundtruth/normals",
                                         "groundtruth/flow"};
constexpr const char* kVideos[] = {"left.mp4", "right.mp4"};
constexpr double kDepthStepMm = 0.01;

bool isNumberedFrame(const fs::path& file) {
  const std::string stem = file.stem().string(), end = file.extension().string();
  return stem.size() == 6 && stem.find_first_not_of("0123456789") == std::string::npos &&
         (end == ".png" || end == ".jpg" || end == ".ply" || end == ".pfm" || end == ".flo");
}

void removeEarlierFrames(const fs::path& folder) {
  for (const char* name : kFrameFolders) {
    if (!fs::is_directory(folder / name)) continue;
    std::vector<fs::path> earlier;
    for (const auto& entry : fs::directory_iterator(folder / name))
      if (isNumberedFrame(entry.path())) earlier.push_back(entry.path());
    for (const fs::path& file : earlier) fs::remove(file);
    if (fs::is_empty(folder / name)) fs::remove(folder / name);
  }
  for (const char* name :
       {"groundtruth/trajectory.txt", "groundtruth/tracks.csv", "track_points.csv",
        "timestamps.txt", "calibration.yaml", "left.mp4", "right.mp4"})
    fs::remove(folder / name);
}

/// A stopped simulation leaves folders without files.
bool holdsFile(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) return true;
  return false;
}

void requireUsableFolder(const fs::path& folder, bool overwrite) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    throw OptionError("`out=`: " + shown(folder) + " is a file, but must be a folder");
  removeAbandoned(folder);
  for (const char* name : kFrameFolders) removeAbandoned(folder / name);
  removeAbandoned(folder / "groundtruth");
  if (!holdsFile(folder)) return;
  if (!overwrite)
    throw OptionError("`out=`: " + shown(folder) +
                      " is not empty; choose another folder, or give `overwrite=`");
  if (!fs::exists(folder / kRecord))
    throw OptionError(
        "`out=`: " + shown(folder) + " holds no " + kRecord +
        ", so it is not a simulation, and `overwrite=` does not change it; choose another folder");
}

template <class Value>
void appendValue(std::string& bytes, const Value& value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

std::string meshPly(const std::vector<Eigen::Vector3f>& vertices_world_mm,
                    const std::vector<Triangle>& triangles) {
  std::string bytes =
      say("ply\nformat binary_little_endian 1.0\n"
          "comment mm, world frame (left camera of frame 0)\nelement vertex ",
          vertices_world_mm.size(),
          "\nproperty float x\nproperty float y\nproperty float z\nelement face ", triangles.size(),
          "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Eigen::Vector3f& p : vertices_world_mm)
    for (int axis = 0; axis < 3; ++axis) appendValue(bytes, p[axis]);
  for (const Triangle& triangle : triangles) {
    bytes.push_back(3);
    for (const std::int32_t vertex : triangle) appendValue(bytes, vertex);
  }
  return bytes;
}

std::string vectorPfm(const Raster<Eigen::Vector3f>& vectors) {
  std::string bytes = say("PF\n", vectors.width_px, " ", vectors.height_px, "\n-1.0\n");
  for (int v = vectors.height_px - 1; v >= 0; --v)
    for (int u = 0; u < vectors.width_px; ++u)
      for (int axis = 0; axis < 3; ++axis) appendValue(bytes, vectors.at(u, v)[axis]);
  return bytes;
}

std::string flowBytes(const Raster<Eigen::Vector2f>& flow_px) {
  constexpr float kUnknownFlow = 1e10F;
  std::string bytes = "PIEH";
  appendValue(bytes, std::int32_t(flow_px.width_px));
  appendValue(bytes, std::int32_t(flow_px.height_px));
  for (const Eigen::Vector2f& flow : flow_px.values)
    for (int axis = 0; axis < 2; ++axis)
      appendValue(bytes, std::isfinite(flow[axis]) ? flow[axis] : kUnknownFlow);
  return bytes;
}

SimulateOutputs::SimulateOutputs(SimulateOutputOptions options, const std::string& record_json)
    : options_(std::move(options)) {
  requireUsableFolder(options_.folder, options_.overwrite);
  if (options_.overwrite) removeEarlierFrames(options_.folder);
  new_files_.makeFolder(options_.folder);
  if (options_.pictures != "mp4")
    for (const char* name : {"left", "right"}) new_files_.makeFolder(options_.folder / name);
  if (options_.input_depth) new_files_.makeFolder(options_.folder / "depth");
  if (options_.truth.depth) new_files_.makeFolder(options_.folder / "groundtruth/depth");
  if (options_.truth.mesh) new_files_.makeFolder(options_.folder / "groundtruth/mesh");
  if (options_.truth.normals) new_files_.makeFolder(options_.folder / "groundtruth/normals");
  if (options_.truth.flow) new_files_.makeFolder(options_.folder / "groundtruth/flow");
  if (options_.truth.trajectory || options_.truth.tracks)
    new_files_.makeFolder(options_.folder / "groundtruth");
  make(options_.folder / kRecord,
       [&](const fs::path& file) { writeFile(file, record_json, options_.overwrite); });
}

fs::path SimulateOutputs::numbered(const char* folder, int index, const std::string& end) const {
  return options_.folder / folder / numberedName(index, "." + end);
}

void SimulateOutputs::writePicture(const char* folder, int index,
                                   const ColourImage& picture) const {
  make(numbered(folder, index, options_.pictures), [&](const fs::path& file) {
    if (options_.pictures == "jpg")
      writeJpeg(file, picture, options_.jpeg_quality, options_.overwrite);
    else
      writePng(file, picture, options_.overwrite);
  });
}

void SimulateOutputs::addToVideos(const StereoPair& pair) {
  for (const char* name : kVideos)
    if (videos_.size() < 2)
      videos_.emplace_back(options_.folder / name, pair.left.width_px, pair.left.height_px,
                           options_.frames_per_second, options_.overwrite);
  parallelInvoke([&] { videos_[0].add(pair.left); }, [&] { videos_[1].add(pair.right); });
}

void SimulateOutputs::writePictures(int index, const StereoPair& pair) {
  if (options_.pictures == "mp4") return addToVideos(pair);
  parallelInvoke([&] { writePicture("left", index, pair.left); },
                 [&] { writePicture("right", index, pair.right); });
}

void SimulateOutputs::addTracks(int index, const SimulatedFrame& frame) {
  for (std::size_t id = 0; id < frame.tracks_world_mm.size(); ++id) {
    const Eigen::Vector3d& p = frame.tracks_world_mm[id];
    char row[128];
    std::snprintf(row, sizeof row, "%d,%zu,%.4f,%.4f,%.4f,%d\n", index, id, p.x(), p.y(), p.z(),
                  frame.tracks_visible[id] ? 1 : 0);
    tracks_csv_ += row;
  }
}

void SimulateOutputs::writeDepth(const char* folder, int index,
                                 const Raster<float>& depth_mm) const {
  make(numbered(folder, index, "png"), [&](const fs::path& file) {
    writeDepthPng(file, depth_mm, kDepthStepMm, options_.overwrite);
  });
}

void SimulateOutputs::writeTruth(int index, const SimulatedFrame& frame,
                                 const std::vector<Triangle>& triangles) const {
  const bool force = options_.overwrite;
  const auto put = [&](const char* folder, const char* end, const std::string& bytes) {
    make(numbered(folder, index, end),
         [&](const fs::path& file) { writeFile(file, bytes, force); });
  };
  if (options_.truth.depth) writeDepth("groundtruth/depth", index, frame.depth_mm);
  if (options_.truth.mesh)
    put("groundtruth/mesh", "ply", meshPly(frame.vertices_world_mm, triangles));
  if (options_.truth.normals) put("groundtruth/normals", "pfm", vectorPfm(frame.normals));
  if (options_.truth.flow) put("groundtruth/flow", "flo", flowBytes(frame.flow_px));
}

void SimulateOutputs::addFrame(int index, const SimulatedFrame& frame,
                               const std::vector<Triangle>& triangles, bool with_truth) {
  writePictures(index, frame.pictures);
  if (options_.input_depth) writeDepth("depth", index, frame.depth_mm);
  if (options_.masks && !frame.instrument.empty()) {
    new_files_.makeFolder(options_.folder / "mask");
    make(numbered("mask", index, "png"),
         [&](const fs::path& file) { writePng(file, frame.instrument, options_.overwrite); });
  }
  if (with_truth) writeTruth(index, frame, triangles);
  trajectory_.push_back(frame.pose);
  addTracks(index, frame);
}

void SimulateOutputs::finish(const Simulator& simulator) {
  const bool force = options_.overwrite;
  const auto put = [&](const char* name, const std::string& bytes) {
    make(options_.folder / name, [&](const fs::path& file) { writeFile(file, bytes, force); });
  };
  for (std::size_t i = 0; i < videos_.size(); ++i)
    make(options_.folder / kVideos[i], [&](const fs::path& /*file*/) { videos_[i].finish(); });
  if (options_.truth.trajectory)
    make(options_.folder / "groundtruth/trajectory.txt",
         [&](const fs::path& file) { writeTrajectory(file, trajectory_, force); });
  if (options_.truth.tracks) {
    std::string points = "id,u_px,v_px\n";
    for (std::size_t id = 0; id < simulator.trackPoints().size(); ++id)
      points += say(id, ",", simulator.trackPoints()[id].u_px, ",",
                    simulator.trackPoints()[id].v_px, "\n");
    put("groundtruth/tracks.csv", tracks_csv_);
    put("track_points.csv", points);
  }
  if (trajectory_.size() > 1) {
    std::string times;
    char row[32];
    for (const TimedPose& pose : trajectory_) {
      std::snprintf(row, sizeof row, "%.6f\n", pose.time_s);
      times += row;
    }
    put("timestamps.txt", times);
  }
  make(options_.folder / "calibration.yaml",
       [&](const fs::path& file) { writeCalibration(file, simulator.calibration(), force); });
  new_files_.keep();
}

}  // namespace softscope
