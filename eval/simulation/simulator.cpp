// eval/simulation/simulator.cpp: the parts of the simulation, put together.
#include "eval/simulation/simulator.h"

#include <algorithm>

#include "core/error.h"
#include "eval/simulation/random.h"

namespace softscope {
namespace {

// One seed a part, so that changing one part leaves the others as they were.
enum Part : std::uint64_t { kTexture = 1, kMotion = 2, kPath = 3, kNoise = 4 };

std::uint64_t seedOf(const SimulationOptions& options, Part part) {
  return mixBits(static_cast<std::uint64_t>(options.seed) * 16 + part);
}

/// The tissue that the scope looks at: the first that lies between it and the middle of the mesh.
Eigen::Vector3d findTarget(const TriangleMesh& mesh, const CameraPathOptions& camera) {
  const RayTree tree(mesh.vertices_mm, mesh.triangles);  // refuses what is no surface
  Eigen::Array3f low = mesh.vertices_mm[0].array(), high = low;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
    low = low.min(vertex.array());
    high = high.max(vertex.array());
  }
  const Eigen::Vector3f middle = 0.5F * (low + high).matrix();
  const Eigen::Vector3f to_scope = scopeDirection(camera).cast<float>();
  const float away_mm = (high - low).matrix().norm();
  const RayHit hit = tree.cast(middle + away_mm * to_scope, -to_scope);
  if (!hit.met())
    throw InputError(
        "the scope looks past the mesh at the middle of its box; turn camera.azimuth_deg or "
        "camera.elevation_deg");
  return (middle + (away_mm - hit.distance) * to_scope).cast<double>();
}

double texelMm(const SimulationOptions& options, const RectifiedRig& rig) {
  if (options.texel_mm > 0) return options.texel_mm;
  return 0.75 * options.camera.distance_mm / rig.left.fx_px;
}

std::vector<Eigen::Vector3f> transformed(const std::vector<Eigen::Vector3f>& points_mm,
                                         const Eigen::Isometry3d& transform) {
  std::vector<Eigen::Vector3f> result;
  result.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm)
    result.push_back((transform * p.cast<double>()).cast<float>());
  return result;
}

const SimulationOptions& validated(const SimulationOptions& options) {
  options.validate();
  return options;
}

}  // namespace

Simulator::Simulator(TriangleMesh rest_mesh, const SimulationOptions& options)
    : options_(validated(options)),
      mesh_(std::move(rest_mesh)),
      rig_(options.scope.rig()),
      target_body_mm_(findTarget(mesh_, options.camera)),
      path_(options.camera, target_body_mm_, rig_.baseline_mm, seedOf(options, kPath)),
      deformation_(mesh_, target_body_mm_.cast<float>(), options.deformation,
                   seedOf(options, kMotion)),
      skin_(mesh_, TissueTexture(mesh_, options.texture, seedOf(options, kTexture)),
            texelMm(options, rig_)),
      light_(options.light, rig_.baseline_mm, options.camera.distance_mm),
      world_from_body_(path_.bodyFromLeft(0).inverse()) {
  const ScopeScene first(worldVertices(0), mesh_.triangles);
  track_points_ = chooseTrackPoints(castCentres(first, rig_.left), options.track_spacing_px);
}

std::vector<Eigen::Vector3f> Simulator::worldVertices(double time_s) const {
  return transformed(deformation_.verticesAt(time_s), world_from_body_);
}

TimedPose Simulator::poseAt(double time_s) const {
  if (time_s == 0) return {0, Eigen::Isometry3d::Identity()};
  return {time_s, world_from_body_ * path_.bodyFromLeft(time_s)};
}

StereoPair Simulator::takePair(const ScopeScene& scene, double time_s, int index) {
  const auto view = [&](float eye_x_mm, std::uint64_t number) {
    const auto light = renderView(scene, skin_, light_, options_.light.relief, rig_.left,
                                  Eigen::Vector3f(eye_x_mm, 0, 0));
    const std::uint64_t seed = mixBits(seedOf(options_, kNoise) + number);
    return takePicture(light, options_.sensor, time_s, seed);
  };
  const auto first = 2 * static_cast<std::uint64_t>(index);
  StereoPair pair;
  pair.left = view(0, first);
  pair.right = view(static_cast<float>(rig_.baseline_mm), first + 1);
  return pair;
}

SimulatedFrame Simulator::frame(int index) {
  require(index >= 0, "frame", index, "must be 0 or above");
  const double time_s = index / options_.frames_per_second;
  SimulatedFrame frame;
  frame.pose = poseAt(time_s);
  frame.vertices_world_mm = worldVertices(time_s);
  const ScopeScene scene(transformed(frame.vertices_world_mm, frame.pose.world_from_left.inverse()),
                         mesh_.triangles);
  frame.pictures = takePair(scene, time_s, index);
  frame.depth_mm = depthOf(castCentres(scene, rig_.left), scene, rig_.left);
  for (const TrackPoint& point : track_points_)
    frame.tracks_world_mm.push_back(positionOf(point, frame.vertices_world_mm, mesh_.triangles));
  return frame;
}

}  // namespace softscope
