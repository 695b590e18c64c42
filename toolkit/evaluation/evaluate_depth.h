// toolkit/evaluation/evaluate_depth.h: the true depth of a frame, from its file or from the true
// surface.
#pragma once

#include <filesystem>

#include "core/raster.h"
#include "core/triangle_mesh.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// Of the rectified left image, mm; NaN where there is no tissue. Without a file in
/// groundtruth/depth, the depth of `mesh_world` as the true camera of this frame would see it.
/// Throws InputError where the file's size isn't the camera's.
Raster<float> trueDepth(const SequenceTruth& truth, int frame, const TriangleMesh& mesh_world);

}  // namespace softscope
