// eval/simulation/sequence/simulator.cpp: the parts of the simulation, combined.
#include "eval/simulation/sequence/simulator.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "eval/simulation/camera/smoke.h"
#include "eval/simulation/noise/random.h"

namespace softscope {
namespace {

// One seed per part: a change of one part does not affect the others.
enum SeedPart : std::uint64_t { kTexture = 1, kMotion = 2, kPath = 3, kNoise = 4 };

constexpr int kShutterMoments = 7;      // for motion blur
constexpr double kSmokeShare = 0.5;     // smoke is half-way to the tissue
constexpr double kSeenWithin_mm = 0.3;  // of the depth at the nearest pixel: slopes between pixels

std::uint64_t seedOf(const SimulationOptions& options, SeedPart part) {
  return mixBits(static_cast<std::uint64_t>(options.seed) * 16 + part);
}

/// The tissue in view: the first between the scope and the middle of the mesh.
Eigen::Vector3d findTarget(const TriangleMesh& mesh, const CameraPathOptions& camera) {
  const RayTree tree(mesh.vertices_mm, mesh.triangles);  // rejects an invalid surface
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

/// The first image of the scope: right, down, forward from the tissue in its middle.
Eigen::Isometry3d viewOf(const CameraPath& path, const Eigen::Vector3d& target_body_mm) {
  Eigen::Isometry3d body_from_view = path.bodyFromLeft(0);
  body_from_view.translation() = target_body_mm;
  return body_from_view;
}

double texelMm(const SimulationOptions& options, const RectifiedRig& rig) {
  if (options.texel_mm > 0) return options.texel_mm;
  return 0.75 * options.camera.distance_mm / rig.left.fx_px;
}

/// From the first pose of the scope.
std::optional<PictureTexture> pictureTexture(const TextureOptions& options, double texel_mm,
                                             const Eigen::Isometry3d& body_from_view) {
  if (options.picture.empty()) return std::nullopt;
  return PictureTexture(options.picture, options.picture_mm, texel_mm, body_from_view);
}

std::vector<Eigen::Vector3f> transformed(const std::vector<Eigen::Vector3f>& points_mm,
                                         const Eigen::Isometry3d& transform) {
  std::vector<Eigen::Vector3f> result;
  result.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm)
    result.push_back((transform * p.cast<double>()).cast<float>());
  return result;
}

/// Tissue at most as deep as the depth at the nearest pixel.
bool isVisible(const Eigen::Vector3d& point_left_mm, const Raster<float>& depth_mm,
               const ScopeLens& left) {
  if (point_left_mm.z() <= 0) return false;
  const Eigen::Vector2d at = left.project(point_left_mm);
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() <= depth_mm.width_px - 1 &&
        at.y() <= depth_mm.height_px - 1))
    return false;
  const float seen_mm = depth_mm.at(int(std::lround(at.x())), int(std::lround(at.y())));
  return point_left_mm.z() <= seen_mm + kSeenWithin_mm;  // false for NaN
}

/// Tissue visible to the right camera.
bool isVisibleToRight(const Eigen::Vector3d& point_left_mm, const ScopeScene& scene,
                      const ScopeTool& instrument, const ScopeLens& lens, double baseline_mm) {
  const Eigen::Vector3d centre_mm(baseline_mm, 0, 0), ray = point_left_mm - centre_mm;
  if (ray.z() <= 0) return false;
  const Eigen::Vector2d at = lens.project(ray);
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() <= lens.camera.width_px - 1 &&
        at.y() <= lens.camera.height_px - 1))
    return false;
  const Eigen::Vector3f origin_mm = centre_mm.cast<float>(),
                        direction = (ray / ray.z()).cast<float>();
  const RayHit hit = scene.tree.cast(origin_mm, direction);
  const auto depth_mm = static_cast<float>(ray.z());
  if (instrument.meet(origin_mm, direction, depth_mm)) return false;
  return !hit.met() || hit.distance >= depth_mm - kSeenWithin_mm;
}

const SimulationOptions& validated(const SimulationOptions& options) {
  options.validate();
  return options;
}

void addShare(const Raster<Eigen::Vector3f>& part, float share, Raster<Eigen::Vector3f>& sum) {
  if (sum.empty())
    sum = Raster<Eigen::Vector3f>(part.width_px, part.height_px, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < sum.size(); ++i) sum.values[i] += share * part.values[i];
}

}  // namespace

Simulator::Simulator(TriangleMesh rest_mesh, const SimulationOptions& options)
    : options_(validated(options)),
      mesh_(std::move(rest_mesh)),
      rig_(options.scope.rig()),
      lens_(options.scope.lens()),
      target_body_mm_(findTarget(mesh_, options.camera)),
      path_(options.camera, target_body_mm_, rig_.baseline_mm, seedOf(options, kPath)),
      body_(cutTissue(mesh_, options.cut, viewOf(path_, target_body_mm_))),
      deformation_(mesh_, target_body_mm_.cast<float>(), options.deformation,
                   seedOf(options, kMotion)),
      skin_(body_,
            TissueTexture(mesh_, options.texture, seedOf(options, kTexture),
                          pictureTexture(options.texture, texelMm(options, rig_),
                                         viewOf(path_, target_body_mm_))),
            texelMm(options, rig_)),
      light_(options.light, rig_.baseline_mm, options.camera.distance_mm),
      world_from_body_(path_.bodyFromLeft(0).inverse()) {
  options_.texture.picture = {};  // already in the skin
  const ScopeScene first(worldVertices(0), body_, 0);
  Raster<RayHit> hits = castCentres(first, lens_);
  const Mask hidden = instrumentMask(hits, instrumentAt(0), lens_);
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hidden.values[i] != 0) hits.values[i] = {};  // hidden: no track starts there
  track_points_ = chooseTrackPoints(hits, options.track_spacing_px, options.track_border);
}

std::vector<Eigen::Vector3f> Simulator::worldVertices(double time_s) {
  return transformed(body_.verticesAt(deformation_.verticesAt(time_s), options_.cut.openAt(time_s)),
                     world_from_body_);
}

TimedPose Simulator::poseAt(double time_s) const {
  if (time_s == 0) return {0, Eigen::Isometry3d::Identity()};
  return {time_s, world_from_body_ * path_.bodyFromLeft(time_s) *
                      options_.event.motionAt(time_s, options_.camera.distance_mm)};
}

ScopeScene Simulator::sceneAt(const std::vector<Eigen::Vector3f>& vertices_world_mm,
                              double time_s) const {
  return {transformed(vertices_world_mm, poseAt(time_s).world_from_left.inverse()), body_,
          options_.cut.openAt(time_s)};
}

ScopeTool Simulator::instrumentAt(double time_s) const {
  return {options_.instrument, rig_.left, options_.camera.distance_mm, time_s};
}

Simulator::LightPair Simulator::lightOf(const ScopeScene& scene, double time_s) {
  const ScopeTool instrument = instrumentAt(time_s);
  const ScopeSurroundings around{light_, options_.light.relief, instrument};
  ScopeEye right{lens_};
  right.lens.camera.cy_px += options_.scope.row_error_px;
  right.centre_mm.x() = static_cast<float>(rig_.baseline_mm);
  const auto roll_rad = static_cast<float>(options_.scope.roll_error_deg * M_PI / 180);
  right.left_from_eye = Eigen::AngleAxisf(roll_rad, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  LightPair pair{renderView(scene, skin_, around, {lens_}),
                 renderView(scene, skin_, around, right)};
  const double cloud_mm = kSmokeShare * options_.camera.distance_mm;
  const double smoke = options_.smoke + options_.event.smokeAt(time_s);
  addSmoke(pair.left, smoke, time_s, 0);
  addSmoke(pair.right, smoke, time_s, rig_.left.fx_px * rig_.baseline_mm / cloud_mm);
  addEvent(pair.left, options_.event, time_s, 0);
  addEvent(pair.right, options_.event, time_s, 1);
  return pair;
}

StereoPair Simulator::develop(const LightPair& light, double time_s, int index) const {
  const auto picture = [&](const Raster<Eigen::Vector3f>& view, std::uint64_t number) {
    return takePicture(view, options_.sensor, time_s, mixBits(seedOf(options_, kNoise) + number));
  };
  const auto first = 2 * static_cast<std::uint64_t>(index);
  return {picture(light.left, first), picture(light.right, first + 1)};
}

void Simulator::addTruth(const ScopeScene& scene, double time_s, SimulatedFrame& frame) const {
  const Raster<RayHit> hits = castCentres(scene, lens_);
  frame.depth_mm = depthOf(hits, scene, lens_);
  frame.normals = normalsOf(hits, scene);
  if (options_.instrument.there()) {
    frame.instrument = instrumentMask(hits, instrumentAt(time_s), lens_);
    for (std::size_t i = 0; i < frame.instrument.size(); ++i)
      if (frame.instrument.values[i] != 0) frame.depth_mm.values[i] = kNotMeasured<float>;
  }
  const Eigen::Isometry3d left_from_world = frame.pose.world_from_left.inverse();
  for (const TrackPoint& point : track_points_) {
    frame.tracks_world_mm.push_back(positionOf(point, frame.vertices_world_mm, triangles()));
    frame.tracks_visible.push_back(
        isVisible(left_from_world * frame.tracks_world_mm.back(), frame.depth_mm, lens_));
    frame.tracks_visible_right.push_back(
        isVisibleToRight(left_from_world * frame.tracks_world_mm.back(), scene,
                         instrumentAt(time_s), lens_, rig_.baseline_mm));
  }
}

/// Where the tissue of each pixel is seen at `time_s`, less where it is seen now.
Raster<Eigen::Vector2f> Simulator::flowTo(double time_s, const Raster<RayHit>& hits,
                                          const Mask& hidden) {
  const ScopeScene next = sceneAt(worldVertices(time_s), time_s);
  Raster<Eigen::Vector2f> flow(hits.width_px, hits.height_px,
                               Eigen::Vector2f::Constant(kNotMeasured<float>));
  parallelRows(flow.height_px, [&](int v) {
    for (int u = 0; u < flow.width_px; ++u) {
      const RayHit& hit = hits.at(u, v);
      if (!hit.met() || (!hidden.empty() && hidden.at(u, v) != 0)) continue;
      const Triangle& t = triangles()[hit.triangle];
      const Eigen::Vector3f p = (1 - hit.u - hit.v) * next.vertices_mm[t[0]] +
                                hit.u * next.vertices_mm[t[1]] + hit.v * next.vertices_mm[t[2]];
      if (p.z() <= 0) continue;
      flow.at(u, v) = (lens_.project(p.cast<double>()) - Eigen::Vector2d(u, v)).cast<float>();
    }
  });
  return flow;
}

/// With an open shutter, the mean of exposures around the frame's time; truth is of the middle one.
/// Before the first frame, the scope moves and the tissue does not.
SimulatedFrame Simulator::frame(int index, bool flow) {
  require(index >= 0, "frame", index, "must be 0 or above");
  const double frame_s = 1 / options_.frames_per_second,
               time_s = index / options_.frames_per_second;
  const int moments = options_.sensor.shutter > 0 ? kShutterMoments : 1, middle = moments / 2;
  SimulatedFrame frame;
  frame.pose = poseAt(time_s);
  LightPair light;
  Raster<RayHit> hits;
  for (int moment = 0; moment < moments; ++moment) {  // in order of time: pushes add up
    const double off_s = options_.sensor.shutter * frame_s * (moment - middle) / moments;
    const double moment_s = moment == middle ? time_s : time_s + off_s;
    const std::vector<Eigen::Vector3f> vertices = worldVertices(std::max(0.0, moment_s));
    const ScopeScene scene = sceneAt(vertices, moment_s);
    const LightPair part = lightOf(scene, moment_s);
    addShare(part.left, 1.0F / float(moments), light.left);
    addShare(part.right, 1.0F / float(moments), light.right);
    if (moment != middle) continue;
    frame.vertices_world_mm = vertices;
    addTruth(scene, time_s, frame);
    if (flow) hits = castCentres(scene, lens_);
  }
  frame.pictures = develop(light, time_s, index);
  if (flow) frame.flow_px = flowTo(time_s + frame_s, hits, frame.instrument);
  return frame;
}

}  // namespace softscope
