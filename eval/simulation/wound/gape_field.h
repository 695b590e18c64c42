// eval/simulation/wound/gape_field.h: displacement of the surface around an opening wound.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Shares, one per vertex: those of `held` are given. Around a slit of `length_mm` the
/// skin follows, at first nearly rigidly, then decaying: across the slit about as (1 + r /
/// reach) exp(-r / reach) with a reach of 0.27 lengths, smooth at the lip, zero far away.
std::vector<double> gapeField(const std::vector<Eigen::Vector3f>& vertices_mm,
                              const std::vector<Triangle>& skin,
                              const std::map<std::int32_t, double>& held, double length_mm);

}  // namespace softscope
