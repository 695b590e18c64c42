// toolkit/face/model_copy.h: models and poses as the public face has them.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/image.h"
#include "softscope/run.h"

namespace softscope::api {

Model modelOf(const std::vector<Eigen::Vector3f>& points_mm,
              const std::vector<Eigen::Vector3f>& normals, const std::vector<Rgb8>& colours,
              const std::vector<float>& weights, std::vector<float> sigmas_mm);

/// x, y, z of each.
std::vector<float> floatsOf(const std::vector<Eigen::Vector3f>& vectors);

Pose poseOf(const Eigen::Isometry3d& pose);

}  // namespace softscope::api
