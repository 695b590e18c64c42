// src/pipeline/model/model_state.h: the model and what goes with it.
#pragma once

#include <Eigen/Geometry>

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

/// What must outlive the program for a run to go on as if it had never stopped.
struct ModelState {
  PointModel model;
  WarpGraph graph;
  InsertionMemory memory;
  MaterialPoints tracked;
  LastingErrors errors;
  LastPicture last;     // kept only where it is matched
  ColourGain exposure;  // of the last image that was fused, against the model's colours
};

}  // namespace softscope
