// toolkit/export/export_gltf.h: a model as glTF.
#pragma once

#include <string>

#include "core/model_surface.h"

namespace softscope {

// glTF 2.0: metres, as the standard demands; POSITION, NORMAL and COLOR_0 (linear light, 16 bits a
// channel) of the vertices as they are. A node turns them so that viewers show them upright: what
// the scope saw as it saw it, a patient from the front. `extras` of the asset tell space and frame.

/// Binary, one file.
std::string glbFile(const ModelSurface& surface);

/// The same as JSON with the data inside.
std::string gltfFile(const ModelSurface& surface);

}  // namespace softscope
