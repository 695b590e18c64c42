// eval/simulation/sequence/simulator.h: stereo images of deforming tissue from a simulated scope,
// with ground truth.
#pragma once

#include <optional>
#include <vector>

#include "core/depth_map.h"
#include "core/image.h"
#include "core/stereo_rig.h"
#include "core/trajectory.h"
#include "core/triangle_mesh.h"
#include "eval/simulation/sequence/simulation_options.h"
#include "eval/simulation/sequence/track_points.h"
#include "eval/simulation/view/scope_view.h"

namespace softscope {

/// One moment. World = the left camera's frame at 0 s.
struct SimulatedFrame {
  StereoPair pictures;
  TimedPose pose;
  std::vector<Eigen::Vector3f> vertices_world_mm;  // vertex i is the same tissue in every frame
  Raster<float> depth_mm;                          // of the left camera, exact; NaN: no tissue
  Mask instrument;                                 // of the left camera; empty where there is none
  Raster<Eigen::Vector3f> normals;                 // left camera's frame, unit; 0: no tissue
  std::vector<Eigen::Vector3d> tracks_world_mm;    // one a track point
  std::vector<bool> tracks_visible;                // to the left camera
  std::vector<bool> tracks_visible_right;          // to the right one
  Raster<Eigen::Vector2f> flow_px;                 // to the next frame, of tissue; NaN: none
};

/// The same options and mesh give the same frames, in any order, on any number of threads.
class Simulator {
 public:
  /// `rest_mesh`: the organ at rest, mm, closed and outward as TriangleMesh says; use
  /// makeOrganMesh() for the built-in one. Throws OptionError, or InputError where the mesh is no
  /// surface that a ray can meet.
  Simulator(TriangleMesh rest_mesh, const SimulationOptions& options);

  /// `flow` costs the next frame's state as well; without it that field stays empty.
  SimulatedFrame frame(int index, bool flow = false);

  const RectifiedRig& rig() const { return rig_; }
  /// As a calibration file says it: rectified, or with the lens's distortion.
  StereoCalibration calibration() const { return options_.scope.calibration(); }
  const std::vector<Triangle>& triangles() const { return body_.mesh.triangles; }
  const std::vector<TrackPoint>& trackPoints() const { return track_points_; }

 private:
  std::vector<Eigen::Vector3f> worldVertices(double time_s);
  TimedPose poseAt(double time_s) const;
  /// What both cameras receive at one moment.
  struct LightPair {
    Raster<Eigen::Vector3f> left, right;
  };
  ScopeScene sceneAt(const std::vector<Eigen::Vector3f>& vertices_world_mm, double time_s) const;
  ScopeTool instrumentAt(double time_s) const;
  LightPair lightOf(const ScopeScene& scene, double time_s);
  StereoPair develop(const LightPair& light, double time_s, int index) const;
  void addTruth(const ScopeScene& scene, double time_s, SimulatedFrame& frame) const;
  Raster<Eigen::Vector2f> flowTo(double time_s, const Raster<RayHit>& hits, const Mask& hidden);

  SimulationOptions options_;
  TriangleMesh mesh_;  // at rest, in the organ's frame
  RectifiedRig rig_;
  ScopeLens lens_;  // of both cameras
  Eigen::Vector3d target_body_mm_;
  CameraPath path_;
  TissueBody body_;
  TissueDeformation deformation_;  // of the organ; the body follows
  TissueSkin skin_;
  ScopeLight light_;
  Eigen::Isometry3d world_from_body_;
  std::vector<TrackPoint> track_points_;
};

}  // namespace softscope
