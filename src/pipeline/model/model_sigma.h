// src/pipeline/model/model_sigma.h: predicted standard error of the model's points.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/camera.h"
#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "stereo/depth/levelled_relief.h"

namespace softscope {

/// What the weights of points don't say of their errors: relief that stereo's windows level out,
/// which errs alike in every frame, and motion of tissue out of sight. docs/fusion.md (F30), (F31).
struct LastingErrors {
  /// Of the last fused frame, one pixel per square of LevelledRelief: camera and pose, depth and
  /// its variance by relief.
  PinholeCamera camera;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  Raster<float> depth_mm;
  Raster<float> variance_mm2;
  double same_surface_mm = 0;  // a point nearer than this to the depth lies on its surface

  /// Around each node, one direction; NaN before it was seen.
  std::vector<float> nodes_mm2;
  std::vector<Eigen::Vector3d> nodes_mm;  // where they were in that frame
  /// Standard error of a point of weight 1; 0: weights say nothing of errors.
  double reference_sigma_mm = 0;

  /// `frame` as it was fused, with its relief; `graph` has live positions. Same input, same bytes.
  void observe(const LevelledRelief& relief, const Observation& frame, const WarpGraph& graph,
               const FusionOptions& options);
};

/// Predicted standard error of each point's distance from the tissue's surface, mm; NaN where
/// unknown. Empty where weights say nothing of errors.
std::vector<float> modelSigmas(const PointModel& model, const WarpGraph& graph,
                               const LastingErrors& errors);

}  // namespace softscope
