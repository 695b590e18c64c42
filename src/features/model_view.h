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
  static constexpr double kMinDiscPx = 1.25;    // avoids holes between far points
  // points within this distance behind the front one belong to its surface
  static constexpr double kSurfaceDepthMm = 1.0;
  int gap_px = 4;  // gaps up to this width in a nearer surface are filled
};

/// All rasters have the size of the camera image.
struct ModelView {
  PinholeCamera camera;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  ColourImage colour;                // black without a surface
  GrayImage anchor;                  // the same with reference intensities
  Raster<float> depth_mm;            // along the optical axis; NaN without a surface
  Raster<std::int32_t> point_index;  // model point nearest to the ray; -1 without a surface
};

/// Renders the front-facing points as discs in their tangent planes: a depth buffer first,
/// then the mean of all discs on the front surface, weighted by the distance to their
/// centres, so that texture is accurate to a fraction of the point spacing. Points that are
/// not finite, behind the camera, or back-facing (by their normal, if any) are omitted.
/// Deterministic for any number of threads. Throws OptionError for invalid options.
ModelView renderModelView(const PointModel& model, const PinholeCamera& camera,
                          const Eigen::Isometry3d& world_from_left,
                          const ModelViewOptions& options);

}  // namespace softscope
