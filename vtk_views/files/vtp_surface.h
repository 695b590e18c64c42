// vtk_views/files/vtp_surface.h: reader of surfaces and points in the formats of VTK.
#pragma once

#include <string>

#include "core/length_unit.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// True for names that end in .vtp or .vtk.
bool looksLikeVtkSurface(const std::string& path);

/// Reads polygons (split into triangles) or, without polygons, points; `space` from the
/// field array SPACE, or from SPACE=LPS or SPACE=RAS in the title of a .vtk file; `unit_mm`: of
/// the file, kUnitOfFile for that of the field array UNIT, or of the title. Throws
/// InputError for an unreadable or empty file, or a coordinate that is not finite.
TriangleMesh readVtkSurface(const std::string& path, double unit_mm = kUnitOfFile);

}  // namespace softscope
