// toolkit/simulation/shipped_layouts.h: simulated clips as SERV-CT, StereoMIS, D4D, STIR (to 2025),
// Hamlyn's mirror and C3VD ship theirs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "toolkit/simulation/dataset_layout.h"

namespace softscope {

/// servct, stereomis, d4d, stir, hamlyn, c3vd; null for another name. All of them with rectified
/// pinholes.
std::unique_ptr<DatasetLayout> makeShippedLayout(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const SimulateOptions& options);

}  // namespace softscope
