// toolkit/run/models_on_disk.h: the models that a run has saved so far, without reading their
// points.
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
  double time_s = 0;  // equals `frame` where the run has no clock
  std::optional<Eigen::Isometry3d> world_from_left;
  PinholeCamera left;  // width_px 0: the file doesn't say it
};

/// What the header of a model tells of its moment (docs/formats.md); models of earlier versions
/// don't. Throws InputError where the file can't be read.
ModelOnDisk readModelHead(int frame, const std::filesystem::path& file);

/// Every models/NNNNNN.ply in the order of frames, else model.ply alone; `known` ones are taken as
/// they are. What a header doesn't say, trajectory.txt, frames.csv and run.json do where they are
/// there. Empty where there is no model yet. Throws InputError.
std::vector<ModelOnDisk> findModelsOnDisk(const std::filesystem::path& run,
                                          const std::vector<ModelOnDisk>& known);

/// Whether the run has ended: then its record is there.
bool runHasEnded(const std::filesystem::path& run);

/// Whether its writer is gone without having ended it: killed, or its machine went down.
bool runHasStopped(const std::filesystem::path& run);

/// Every place of the scope that the run's tables tell, with its frame; empty while they aren't
/// there.
std::vector<std::pair<int, Eigen::Vector3f>> readScopePath(const std::filesystem::path& run);

}  // namespace softscope
