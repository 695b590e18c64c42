// src/pipeline/model/model_state.h: the model and what goes with it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/colour_gain.h"
#include "fusion/point_insertion.h"
#include "pipeline/model/model_sigma.h"
#include "pipeline/tracks/material_points.h"

namespace softscope {

/// What the scope saw when the model last learned.
struct LastPicture {
  ColourImage left;  // rectified
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

/// Neighbouring points far from the view that take no part in the frames: active_region.h.
struct InactivePoints {
  PointModel points;                  // as they were then; bindings: into `stencils`
  std::vector<NodeStencil> stencils;  // of places in `nodes`
  std::vector<std::int32_t> nodes;    // of the graph, ascending
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;  // of nodes that share a point
  std::vector<Eigen::Vector3d> nodes_mm;  // then: of these, positions_mm and turned of the graph
  std::vector<Eigen::Matrix3d> turned;
};

/// What must outlive the program for a run to go on as if it had never stopped.
struct ModelState {
  PointModel model;
  WarpGraph graph;
  std::vector<InactivePoints> inactive;  // active_region.h
  InsertionMemory memory;
  MaterialPoints tracked;
  LastingErrors errors;
  LastPicture last;     // kept only where it is matched
  ColourGain exposure;  // of the last image that was fused, against the model's colours
};

}  // namespace softscope
