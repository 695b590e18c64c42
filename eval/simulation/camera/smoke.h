// eval/simulation/camera/smoke.h: smoke between scope and tissue.
#pragma once

#include <Eigen/Core>

#include "core/raster.h"

namespace softscope {

/// Greys the linear `light` of one camera: 0 nothing, 1 a thick cloud that hides half of the
/// contrast on average. It drifts and curls with time. `shift_px`: how far left this camera sees
/// the cloud beside the left camera.
void addSmoke(Raster<Eigen::Vector3f>& light, double smoke, double time_s, double shift_px);

}  // namespace softscope
