// src/pipeline/frame/tissue_colour.h: whether an image shows the tissue of a model.
#pragma once

#include "core/image.h"
#include "core/point_model.h"
#include "core/raster.h"

namespace softscope {

/// True if the measured pixels have at least half of the model's redness (medians): gauze and smoke
/// have none. True without any red in the model. The rasters have the same shape.
bool isAsRed(const ColourImage& left, const Raster<float>& depth_mm, const PointModel& model);

}  // namespace softscope
