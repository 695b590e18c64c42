// eval/simulation/camera/smoke.h: smoke between scope and tissue.
#pragma once

#include <Eigen/Core>

#include "core/raster.h"

namespace softscope {

/// Blends grey into the linear `light` of one camera: 0 none, 1 a thick cloud
/// that halves the contrast on average. It drifts with time. `shift_px`:
/// displacement of the cloud to the left, relative to the left camera.
void addSmoke(Raster<Eigen::Vector3f>& light, double smoke, double time_s, double shift_px);

}  // namespace softscope
