// toolkit/export/export_gltf.h: a model as glTF.
#pragma once

#include <string>

#include "core/model_surface.h"

namespace softscope {

// glTF 2.0 in metres, as the standard requires; POSITION, NORMAL and COLOR_0 (linear light,
// 16 bits per channel) of the vertices. A node rotates them upright: camera views as seen
// by the scope, a patient from the front. `extras` of the asset name space and frame.

/// Binary, one file.
std::string glbFile(const ModelSurface& surface);

/// JSON with embedded data.
std::string gltfFile(const ModelSurface& surface);

}  // namespace softscope
