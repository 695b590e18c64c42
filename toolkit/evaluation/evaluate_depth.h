// toolkit/evaluation/evaluate_depth.h: true depth of a
// frame, from its file or rendered from the true surface.
#pragma once

#include <filesystem>

#include "core/raster.h"
#include "core/triangle_mesh.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// For the rectified left image, mm; NaN outside of the tissue. Without a
/// file in groundtruth/depth, `mesh_world` is rendered from the true pose of
/// this frame. Throws InputError for a file of another size than the camera.
Raster<float> trueDepth(const SequenceTruth& truth, int frame, const TriangleMesh& mesh_world);

}  // namespace softscope
