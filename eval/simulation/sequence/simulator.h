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

/// One frame. World = left camera frame at 0 s.
struct SimulatedFrame {
  StereoPair pictures;
  TimedPose pose;
  std::vector<Eigen::Vector3f> vertices_world_mm;  // of the left camera, exact; NaN: no tissue
  Raster<float> depth_mm;                          // of the left camera; empty: no instrument
  Mask instrument;                                 // left camera frame, unit length; 0: no tissue
  Raster<Eigen::Vector3f> normals;                 // one per track point
  std::vector<Eigen::Vector3d> tracks_world_mm;    // one a track point
  std::vector<bool> tracks_visible;                // to the left camera
  std::vector<bool> tracks_visible_right;          // to the right camera
  Raster<Eigen::Vector2f> flow_px;                 // to the next frame, of tissue; NaN: none
};

/// Deterministic: equal options and mesh give equal frames, in any order, on any threads.
class Simulator {
 public:
  /// `rest_mesh`: organ at rest, mm, closed, outward orientation
  /// as in TriangleMesh; built-in organ: makeOrganMesh(). Throws
  /// OptionError, or InputError for an invalid surface.
  Simulator(TriangleMesh rest_mesh, const SimulationOptions& options);

  /// `flow` also requires the state of the next frame; otherwise that field is empty.
  SimulatedFrame frame(int index, bool flow = false);

  const RectifiedRig& rig() const { return rig_; }
  /// As in a calibration file: rectified, or with lens distortion.
  StereoCalibration calibration() const { return options_.scope.calibration(); }
  const std::vector<Triangle>& triangles() const { return body_.mesh.triangles; }
  const std::vector<TrackPoint>& trackPoints() const { return track_points_; }

 private:
  std::vector<Eigen::Vector3f> worldVertices(double time_s);
  TimedPose poseAt(double time_s) const;
  /// Light received by both cameras at one time.
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
  TriangleMesh mesh_;  // at rest, in the frame of the organ
  RectifiedRig rig_;
  ScopeLens lens_;  // of both cameras
  Eigen::Vector3d target_body_mm_;
  CameraPath path_;
  TissueBody body_;
  TissueDeformation deformation_;  // of the organ; the body follows it
  TissueSkin skin_;
  ScopeLight light_;
  Eigen::Isometry3d world_from_body_;
  std::vector<TrackPoint> track_points_;
};

}  // namespace softscope
