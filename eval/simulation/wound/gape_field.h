// eval/simulation/wound/gape_field.h: displacement of the surface beside an opening wound.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Shares, one a vertex: those of `held` are given. Beside the lips of a slit of `length_mm` the
/// skin follows, first nearly rigidly, then less and less: across, about as (1 + r / reach)
/// exp(-r / reach) with a reach of 0.27 lengths, so without a kink at the lip; far away it rests.
std::vector<double> gapeField(const std::vector<Eigen::Vector3f>& vertices_mm,
                              const std::vector<Triangle>& skin,
                              const std::map<std::int32_t, double>& held, double length_mm);

}  // namespace softscope
