// vtk_views/files/surface_vtp.h: a model as ParaView and 3D Slicer read it.
#pragma once

#include <string>

#include "core/model_surface.h"

namespace softscope {

/// A VTP file (appended, compressed): triangles, or one vertex a point where there are none; the
/// arrays Normals, RGB and weight where the model has them; the field arrays UNIT, and SPACE or
/// FRAME where they are known. Throws Error where VTK can't write it.
std::string surfaceVtp(const ModelSurface& surface, const LengthUnit& unit = {});

}  // namespace softscope
