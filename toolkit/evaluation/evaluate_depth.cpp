// toolkit/evaluation/evaluate_depth.cpp: depth from a file, or by ray casting.
#include "toolkit/evaluation/evaluate_depth.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/simulation/surface/ray_tree.h"
#include "eval/surfaces/surface_alignment.h"
#include "io/geometry/depth_files.h"
#include "io/text/message.h"

namespace softscope {
namespace {

Raster<float> castDepth(const TriangleMesh& mesh_world, const PinholeCamera& left,
                        const Eigen::Isometry3d& left_from_world) {
  const RayTree tree(movePoints(left_from_world, mesh_world.vertices_mm), mesh_world.triangles);
  Raster<float> depth_mm(left.width_px, left.height_px, std::numeric_limits<float>::quiet_NaN());
  constexpr int kRays = std::tuple_size_v<RayPacket>;
  parallelRows(left.height_px, [&](int v) {
    for (int begin = 0; begin < left.width_px; begin += kRays) {
      RayPacket rays;  // the last rays of a row may be outside the image
      for (int i = 0; i < kRays; ++i)
        rays[std::size_t(i)] = liftPixel<double>(left, begin + i, v, 1).cast<float>();
      const PacketHits hits = tree.cast(Eigen::Vector3f::Zero(), rays);
      for (int u = begin; u < std::min(begin + kRays, left.width_px); ++u)
        if (const RayHit& hit = hits[std::size_t(u - begin)]; hit.met())
          depth_mm.at(u, v) = hit.distance;  // the direction has z = 1
    }
  });
  return depth_mm;
}

}  // namespace

Raster<float> trueDepth(const SequenceTruth& truth, int frame, const TriangleMesh& mesh_world) {
  const PinholeCamera& left = truth.rig.left;
  const auto& pose = truth.poses.at(frame);
  const auto file = truth.depths.find(frame);
  if (file == truth.depths.end() || !truth.rectified)  // the file has the pixels of the raw image
    return castDepth(mesh_world, left, pose.world_from_left.inverse());
  Raster<float> depth_mm = readDepth(file->second, truth.depth_unit_mm);
  if (depth_mm.width_px != left.width_px || depth_mm.height_px != left.height_px)
    throw InputError(say(shown(file->second), ": has ", depth_mm.width_px, " x ",
                         depth_mm.height_px, " pixels, but the calibration says ", left.width_px,
                         " x ", left.height_px, "; give the depth of this camera"));
  return depth_mm;
}

}  // namespace softscope
