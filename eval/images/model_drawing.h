// eval/images/model_drawing.h: z-buffer rendering of a point model, for the evaluation alone.
#pragma once

#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/image.h"
#include "core/point_model.h"
#include "core/raster.h"

namespace softscope {

/// Rasters of the camera's shape.
struct ModelDrawing {
  ColourImage colour;      // black where nothing is drawn
  Raster<float> depth_mm;  // along the optical axis; NaN where nothing is drawn
};

/// Median distance from a point of the model to its nearest neighbour, of at most 500 points,
/// evenly spread over the model's order; 0 with fewer than two finite points.
double nearestNeighbourMm(const PointModel& model);

/// Surface splatting (Zwicker et al., SIGGRAPH 2001): each point is a disc in its tangent plane.
/// The nearest disc of a pixel decides which surface is seen; colour and depth are the mean of the
/// discs of that surface, weighted by a Gaussian of the distance from their centres. Radius: 1.5
/// times nearestNeighbourMm, and as large as a pixel at least. Gaps stay gaps. Points that are not
/// finite, not in front of the camera, or whose normal turns away are left out; a point without
/// normal faces the camera. Shares no code with the reconstruction (src/features).
ModelDrawing drawModel(const PointModel& model, const PinholeCamera& camera,
                       const Eigen::Isometry3d& world_from_left);

}  // namespace softscope
