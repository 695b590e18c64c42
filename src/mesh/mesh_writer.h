// src/mesh/mesh_writer.h: a model as PLY, OBJ or STL.
#pragma once

#include <string>

#include "core/model_surface.h"

namespace softscope {

// The bytes of a file. Headers name the unit, and the space or the scope's frame where it is known.
// A normal that isn't finite becomes 0 0 0. Sigmas are in mm whatever the unit. All throw Error
// where normals, colours, weights or sigmas are neither none nor one a vertex, or a triangle names
// a vertex that isn't there.

/// Binary little-endian: vertices as writePly has them, then triangles (none for points alone).
std::string plyFile(const ModelSurface& surface, const LengthUnit& unit = {});

/// Text; colours stand behind the coordinates, 0 to 1, as MeshLab, Blender and CloudCompare read
/// them. Throws Error where there are no triangles.
std::string objFile(const ModelSurface& surface, const LengthUnit& unit = {});

/// Binary: triangles with the normals of their faces; no colours. Throws Error where there are
/// none.
std::string stlFile(const ModelSurface& surface, const LengthUnit& unit = {});

/// Throws the Error that all of them throw.
void requireConsistent(const ModelSurface& surface);

}  // namespace softscope
