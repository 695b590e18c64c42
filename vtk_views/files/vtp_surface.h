// vtk_views/files/vtp_surface.h: surfaces and points in VTK's own files.
#pragma once

#include <string>

#include "core/triangle_mesh.h"

namespace softscope {

/// True for names that end in .vtp or .vtk.
bool looksLikeVtkSurface(const std::string& path);

/// Reads polygons (cut into triangles) or, where there are none, points; `space` from the field
/// array SPACE, or from SPACE=LPS or SPACE=RAS in the title of a .vtk file. Throws InputError where
/// the file can't be read, holds nothing, or a coordinate is not finite.
TriangleMesh readVtkSurface(const std::string& path);

}  // namespace softscope
