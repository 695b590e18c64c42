// toolkit/run/saved_model.h: the model of one frame in a run folder.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "core/camera.h"
#include "core/point_cloud.h"

namespace softscope {

/// Folders of a run: models/NNNNNN.ply and .vtp, nodes/NNNNNN.csv.
inline constexpr const char* kModels = "models";
inline constexpr const char* kNodes = "nodes";

/// What a viewer needs that reads one model alone, also while the run goes on.
struct ModelMoment {
  int frame = 0;
  double time_s = 0;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  PinholeCamera left;
};

/// `cloud` and `nodes_mm`: world frame. Replaces earlier files. Throws InputError for folders that
/// can't be made, Error for files that can't be written.
void writeSavedModel(const std::filesystem::path& run, const ModelMoment& moment,
                     const PointCloud& cloud, const std::vector<Eigen::Vector3d>& nodes_mm);

/// Into another world; `moment` is that before. A model that was moved already, by a run that was
/// killed since, stays.
void moveSavedModel(const std::filesystem::path& run, const ModelMoment& moment,
                    const Eigen::Isometry3d& into_from);

/// All of the run's.
void removeSavedModels(const std::filesystem::path& run);

}  // namespace softscope
