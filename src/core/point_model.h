// src/core/point_model.h: surface points with normal, colour, weight, skinning weights.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/hd.h"
#include "core/image.h"

namespace softscope {

/// Number of nodes of the warp graph per point: k of the paper.
constexpr int kNodesPerPoint = 4;

/// Skinning weights of a point. 20 bytes.
struct PointBinding {
  static constexpr std::int32_t kUnbound = -1;
  std::int32_t stencil = kUnbound;              // index into WarpGraph::stencils
  std::array<float, kNodesPerPoint> weights{};  // sum 1; 0 for unused slots

  SOFTSCOPE_HD bool bound() const { return stencil != kUnbound; }
};

/// N points, mm, in the world frame. Structure of arrays of size N; 64 bytes per point.
struct PointModel {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Eigen::Vector3f> normals;  // unit length, outward
  std::vector<Rgb8> colours;
  std::vector<std::uint8_t> anchors;  // reference intensities: docs/fusion.md (F24)
  std::vector<float> weights;         // accumulated inverse variance
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

  /// The new point is unbound until the graph is extended.
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
