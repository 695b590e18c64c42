// vtk_views/files/surface_vtp.h: model for ParaView and 3D Slicer.
#pragma once

#include <string>

#include "core/model_surface.h"

namespace softscope {

/// VTP file (appended, compressed): triangles, or one vertex per point
/// without triangles; the arrays Normals, RGB and weight if present; the
/// field arrays UNIT, and SPACE or FRAME if known. Throws Error if VTK fails.
std::string surfaceVtp(const ModelSurface& surface, const LengthUnit& unit = {});

}  // namespace softscope
