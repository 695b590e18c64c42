// cuda/model/model_layout.h: the model's points in memory of the device.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/point_model.h"
#include "cuda/device/arena.h"
#include "fusion/model_point.h"

namespace softscope::cuda {

/// Members of PointModel; owns nothing.
struct ModelArrays {
  ModelArrays() = default;
  ModelArrays(Arena& arena, std::size_t points) {
    positions_mm = arena.array<Eigen::Vector3f>(points);
    normals = arena.array<Eigen::Vector3f>(points);
    colours = arena.array<Rgb8>(points);
    anchors = arena.array<std::uint8_t>(points);
    weights = arena.array<float>(points);
    bindings = arena.array<PointBinding>(points);
  }

  SOFTSCOPE_HD ModelPoint at(int i) const {
    return {positions_mm[i], normals[i], colours[i], anchors[i], weights[i]};
  }
  SOFTSCOPE_HD void set(int i, const ModelPoint& point) const {
    positions_mm[i] = point.position_mm;
    normals[i] = point.normal;
    colours[i] = point.colour;
    anchors[i] = point.anchor;
    weights[i] = point.weight;
  }

  Eigen::Vector3f *positions_mm = nullptr, *normals = nullptr;
  Rgb8* colours = nullptr;
  std::uint8_t* anchors = nullptr;
  float* weights = nullptr;
  PointBinding* bindings = nullptr;
};

}  // namespace softscope::cuda
