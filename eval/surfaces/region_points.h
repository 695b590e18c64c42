// eval/surfaces/region_points.h: the measured points that a reference can judge.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/raster.h"

namespace softscope {

/// Lifts the measured pixels of a region to 3-D: mm, in the camera's frame, row by row.
/// `region` says what to judge (non-zero = judge: an evaluation mask, the opposite of a Mask).
/// Throws InputError where sizes differ.
std::vector<Eigen::Vector3f> pointsInRegion(const Raster<float>& depth_mm,
                                            const PinholeCamera& camera,
                                            const Raster<std::uint8_t>& region);

}  // namespace softscope
