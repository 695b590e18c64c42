// toolkit/run/model_surface.h: triangles between the points of a reconstructed model.
#pragma once

#include "core/triangle_mesh.h"
#include "toolkit/run/model_file.h"

namespace softscope {

/// All points of the model in their order, with colours where it has them, and the triangles of
/// surfaceFromPoints() between them; without triangles where the points have no normals or make no
/// surface. Vertices that no triangle uses are outliers.
TriangleMesh modelSurface(const ModelFile& file);

}  // namespace softscope
