// toolkit/simulation/shipped_layouts.h: folder layouts of SERV-CT,
// StereoMIS, D4D, STIR (up to 2025), Hamlyn's mirror and C3VD.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "toolkit/simulation/dataset_layout.h"

namespace softscope {

/// servct, stereomis, d4d, stir, hamlyn, c3vd; null for
/// another name. All with rectified pinhole cameras.
std::unique_ptr<DatasetLayout> makeShippedLayout(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const SimulateOptions& options);

}  // namespace softscope
