// toolkit/run/models_on_disk.h: saved
// models of a run, without their points.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/camera.h"

namespace softscope {

struct ModelOnDisk {
  int frame = 0;
  std::filesystem::path file;
  double time_s = 0;  // equals `frame` for a run without timestamps
  std::optional<Eigen::Isometry3d> world_from_left;
  PinholeCamera left;  // width_px 0: unknown
};

/// Frame data in the header of a model (docs/formats.md); missing in
/// models of earlier versions. Throws InputError for an unreadable file.
ModelOnDisk readModelHead(int frame, const std::filesystem::path& file);

/// Every models/NNNNNN.ply in the order of frames, else model.ply only; `known` models
/// are not read again. Missing header entries are taken from trajectory.txt, frames.csv
/// and run.json if present. Empty for a run without a model. Throws InputError.
std::vector<ModelOnDisk> findModelsOnDisk(const std::filesystem::path& run,
                                          const std::vector<ModelOnDisk>& known);

/// True for a finished run: its record exists.
bool runHasEnded(const std::filesystem::path& run);

/// True if the writing process ended without finishing the run.
bool runHasStopped(const std::filesystem::path& run);

/// Camera positions in the tables of the run, in the world of
/// the first map, with their frames; empty without tables.
std::vector<std::pair<int, Eigen::Vector3f>> readScopePath(const std::filesystem::path& run);

}  // namespace softscope
