// src/features/lift_matches.h: matched points in mm from matched pixels.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/depth_map.h"
#include "features/matcher.h"
#include "features/model_view.h"

namespace softscope {

/// One point of tissue, on the model and as measured in the live frame.
struct LiftedMatch {
  std::int32_t model_point = 0;     // of the model, nearest to the ray
  Eigen::Vector3f source_world_mm;  // on the model
  Eigen::Vector3f target_left_mm;   // measured, in the live left camera frame
  float across_mm = 0;              // predicted standard errors of the target: across …
  float along_mm = 0;               // … and along the ray of the live camera; NaN without sigma
  float similarity = 0;             // of the pixel match
  int match = 0;                    // its index
};

/// Depth at a sub-pixel position, bilinear in the inverse depth (exact on planes); NaN
/// if one of the four pixels is unmeasured or they differ by more than `max_step_mm`.
float depthAt(const Raster<float>& depth_mm, const Eigen::Vector2f& place_px, float max_step_mm);

/// In floats, for liftMatches() on CPU and GPU.
struct RigidRows;
RigidRows rigidRows(const Eigen::Isometry3d& motion);

/// Converts the model side by the depth of the view and the live side by the depth
/// map (sigma_mm may be empty); leaves out matches without depth. Keeps the order.
std::vector<LiftedMatch> liftMatches(const std::vector<PixelMatch>& matches, const ModelView& view,
                                     const DepthMap& live_depth, const PinholeCamera& live_camera);

}  // namespace softscope
