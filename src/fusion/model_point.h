// src/fusion/model_point.h: one point of the model as a value.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/image.h"

namespace softscope {

/// World frame, mm; members as in PointModel, without the binding. 32 bytes.
struct ModelPoint {
  Eigen::Vector3f position_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Rgb8 colour;
  std::uint8_t anchor = 0;
  float weight = 0;
};

}  // namespace softscope
