// eval/images/model_drawing.h: z-buffer rendering of a point model, for evaluation only.
#pragma once

#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/image.h"
#include "core/point_model.h"
#include "core/raster.h"

namespace softscope {

/// Rasters of the size of the camera image.
struct ModelDrawing {
  ColourImage colour;      // black without a surface
  Raster<float> depth_mm;  // along the optical axis; NaN without a surface
};

/// Median distance of a point to its nearest neighbour, over at most 500 points,
/// evenly spread over the order of the model; 0 with fewer than two finite points.
double nearestNeighbourMm(const PointModel& model);

/// Surface splatting (Zwicker et al., SIGGRAPH 2001): each point is a disc in its tangent
/// plane. The nearest disc of a pixel selects the visible surface; colour and depth are the
/// mean over the discs of that surface, with Gaussian weights by the distance to their centres.
/// Radius: 1.5 times nearestNeighbourMm, at least the size of a pixel. Gaps are not filled.
/// Points that are not finite, not in front of the camera or back-facing are omitted; a point
/// without a normal faces the camera. Shares no code with the reconstruction (src/features).
ModelDrawing drawModel(const PointModel& model, const PinholeCamera& camera,
                       const Eigen::Isometry3d& world_from_left);

}  // namespace softscope
