// toolkit/run/model_surface.h: triangulation of a reconstructed model.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/run/model_file.h"

namespace softscope {

/// All points of the model in their order, with available colours, and the
/// triangles of surfaceFromPoints(); no triangles for points without
/// normals or without a surface. Vertices without a triangle are outliers.
TriangleMesh modelSurface(const ModelFile& file);

}  // namespace softscope
