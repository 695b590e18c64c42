// src/core/point_model.h: surface points of the tissue with normal, colour, weight and binding.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace softscope {

/// How many nodes of the warp graph carry one point: the paper's k.
constexpr int kNodesPerPoint = 4;

/// Which nodes carry a point, and how strongly. 20 bytes.
struct PointBinding {
  static constexpr std::int32_t kUnbound = -1;
  std::int32_t stencil = kUnbound;              // index into WarpGraph::stencils
  std::array<float, kNodesPerPoint> weights{};  // in the stencil's order, sum 1; 0 in unused slots

  bool bound() const { return stencil != kUnbound; }
};

/// N points, mm, in the world frame. Structure of arrays, each N long; 64 bytes a point.
struct PointModel {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Eigen::Vector3f> normals;  // unit length, out of the tissue
  std::vector<Rgb8> colours;
  std::vector<std::uint8_t> anchors;  // brightness as the point first looked: docs/fusion.md (F24)
  std::vector<float> weights;         // how often, and how well, the point was seen
  std::vector<PointBinding> bindings;

  std::size_t size() const { return positions_mm.size(); }
  bool empty() const { return positions_mm.empty(); }

  void reserve(std::size_t count) {
    positions_mm.reserve(count);
    normals.reserve(count);
    colours.reserve(count);
    anchors.reserve(count);
    weights.reserve(count);
    bindings.reserve(count);
  }

  /// The new point is unbound until the graph has grown over it.
  void add(const Eigen::Vector3f& position_mm, const Eigen::Vector3f& normal, Rgb8 colour,
           float weight) {
    positions_mm.push_back(position_mm);
    normals.push_back(normal);
    colours.push_back(colour);
    anchors.push_back(toGray(colour));
    weights.push_back(weight);
    bindings.emplace_back();
  }
};

}  // namespace softscope
