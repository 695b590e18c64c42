// src/pipeline/reconstruction_backend.h: interface between the frame loop and the stages.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/point_model.h"
#include "core/stereo_rig.h"
#include "deform/solver/lm_solver.h"
#include "fusion/back_projection_error.h"
#include "fusion/view_evidence.h"
#include "pipeline/frame/depth_summary.h"
#include "pipeline/frame/pose_summary.h"
#include "pipeline/model/model_state.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"
#include "stereo/matching/stereo_matcher.h"

namespace softscope {

struct MatchSummary {
  int matches = 0;  // pixels of the model view found again
  int lifted = 0;   // of those, with depth on both sides
};

/// Stages 2 to 4 of one frame.
struct LocateSummary {
  MatchSummary matches;
  PoseSummary pose;
};

struct WarpSummary {
  DeformSummary solver;
  int in_sight = 0;  // points that the depth may pull
  int nodes = 0;
};

/// Evidence for the pose and the warp of a frame.
struct EvidenceSummary {
  BackProjectionError predicted;  // of the warped model, before fusion
  ViewEvidence view;
};

struct FusionSummary {
  int points = 0;
  int seen = 0, fused = 0, inserted = 0, contradicted = 0;
  BackProjectionError corrected;  // of the model as it is now: the paper's number
};

/// What is known once all stages of a frame are done.
struct FrameOutcome {
  FusionSummary fusion;                  // zeros where nothing was fused
  std::vector<TrackedPosition> tracked;  // position, and whether the pose given sees it
  StageTimes times;                      // in the order of work; verbs called twice add up
};

/// The working set of a run, and one verb a stage. The reconstructor owns the order. Poses are
/// world_from_left, mm. A verb works on what the verbs before it left for this frame.
class ReconstructionBackend {
 public:
  virtual ~ReconstructionBackend() = default;
  virtual std::string name() const = 0;    // "cpu" or "cuda"; written into every report
  virtual std::string device() const = 0;  // which processor or GPU
  virtual const RectifiedRig& rig() const = 0;

  /// May begin what needs no model of the frames that come next. Results don't depend on it.
  virtual void prepare(const UpcomingFrames& /*upcoming*/) {}
  /// Stage 1: rectifies, masks and measures. Throws InputError where the frame doesn't fit.
  virtual DepthSummary measure(const Frame& frame) = 0;
  /// Stages 2 to 4: draws the model from that pose, finds its pixels in the live image, and the
  /// pose from them. `last` is the pose of the last frame that was fused, `reference` the last one
  /// that differed significantly from its predecessor.
  virtual LocateSummary locate(const Eigen::Isometry3d& viewed_from, const Eigen::Isometry3d& last,
                               const Eigen::Isometry3d& reference, ScopeBefore before) = 0;
  /// A pose near enough for locate(), sought over the whole image from all these viewpoints of the
  /// model, which may be another than the back end's.
  virtual RigidPose relocalise(const PointModel& model,
                               const std::vector<Eigen::Isometry3d>& viewpoints) = 0;
  /// Whether the measured pixels of the frame are as red as the model: false for gauze.
  virtual bool showsTissue() const = 0;
  /// Stages 5 and 6: finds the warp; nothing moves before acceptWarp(). `before`: as in locate();
  /// tissue may have moved far where it is unclear.
  virtual WarpSummary findWarp(const Eigen::Isometry3d& world_from_left, ScopeBefore before) = 0;
  /// Carries points, nodes and tracked points to the live shape. `is_reference`: that is the shape
  /// in which later poses are measured.
  virtual void acceptWarp(bool is_reference) = 0;
  /// After acceptWarp(): compares the model with the frame, before fusion.
  virtual EvidenceSummary confirm(const Eigen::Isometry3d& world_from_left) = 0;
  /// The model is again as it was before findWarp(), also after acceptWarp().
  virtual void rejectWarp() = 0;
  /// Stage 7: brings the model up to the frame; an empty model begins with it. May return before
  /// that is done; finish() waits.
  virtual void fuse(const Eigen::Isometry3d& world_from_left) = 0;
  /// Ends every frame, fused or not. The tracked points are where they are now.
  virtual FrameOutcome finish(const Eigen::Isometry3d& world_from_left) = 0;

  virtual bool empty() const = 0;
  /// All points of the model take part again, for views from anywhere.
  virtual void activateAll() = 0;
  /// Follows these tissue points; they lie in the first frame that is fused.
  virtual void track(const std::vector<TrackSeed>& seeds) = 0;
  /// Valid until the next call that changes the model.
  virtual const ModelState& state() const = 0;
  virtual void restore(ModelState state) = 0;
  /// Adds the points of another model where the back end's has none.
  virtual void add(const ModelState& other, const Eigen::Isometry3d& world_from_other) = 0;
};

}  // namespace softscope
