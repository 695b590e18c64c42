// src/features/model_view.h: the model rendered from a camera pose.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "core/camera.h"
#include "core/image.h"
#include "core/point_model.h"

namespace softscope {

struct ModelViewOptions {
  double point_spacing_mm = 0.2;                // of the model's points: fusion.point_spacing_mm
  static constexpr double kDiscSpacings = 0.9;  // radius of a disc, in spacings; larger discs blur
  static constexpr double kMinDiscPx = 1.25;    // so that far points leave no holes between pixels
  // points this far behind the front one belong to its surface
  static constexpr double kSurfaceDepthMm = 1.0;
  int gap_px = 4;  // gaps up to this wide in a nearer surface are closed
};

/// All rasters have the camera's shape.
struct ModelView {
  PinholeCamera camera;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  ColourImage colour;                // black where nothing is seen
  GrayImage anchor;                  // the same, as the points first looked
  Raster<float> depth_mm;            // along the optical axis; NaN where nothing is seen
  Raster<std::int32_t> point_index;  // the model point nearest to the ray; -1 where there is none
};

/// Draws the points that face the camera as discs in their tangent planes: a depth buffer first,
/// then the mean of all discs on the front surface, weighted by distance from their centres, so
/// that texture keeps its place to a fraction of the points' spacing. Points that are not finite,
/// behind the camera, or whose normal (if it has one) turns away aren't drawn. Same input, same
/// bytes, whatever the number of threads. Throws OptionError on bad options.
ModelView renderModelView(const PointModel& model, const PinholeCamera& camera,
                          const Eigen::Isometry3d& world_from_left,
                          const ModelViewOptions& options);

}  // namespace softscope
