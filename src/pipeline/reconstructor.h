// src/pipeline/reconstructor.h: the method, frame by frame.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/frame_record.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// Everything that a run needs to go on where it stopped.
template <class Model>
struct StateOf {
  Model model;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_pose = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Isometry3d> key_views;
  bool lost = false;
  int unfused_frames = 0;  // since the last one that was fused
  int searches = 0;        // of them, in which the model was sought over the whole image
};
using ReconstructionState = StateOf<ModelState>;
/// Refers to a Reconstructor's model: valid until its next frame is processed.
using ReconstructionStateView = StateOf<const ModelState&>;

/// Owns the order of the stages; the back end owns what they work on.
class Reconstructor {
 public:
  Reconstructor(std::unique_ptr<ReconstructionBackend> backend,
                const ReconstructionOptions& options);

  /// One frame, from images to the updated model. A frame that isn't good enough leaves the
  /// model as it was; the record says why. `next` and `after`: the two frames after it, where they
  /// are known already, so that their depth may begin meanwhile; each must live until it is
  /// processed itself, or the frame that takes its place. The model doesn't depend on them.
  FrameRecord process(const Frame& frame, const Frame* next = nullptr,
                      const Frame* after = nullptr);

  /// A frame that could not even be read, or has no partner.
  FrameRecord skip(int index, const std::string& reason, double time_s = kUnknown,
                   FrameStatus status = FrameStatus::kUnreadable);

  /// Before the first frame.
  void track(const std::vector<TrackSeed>& seeds) { backend_->track(seeds); }

  const ReconstructionBackend& backend() const { return *backend_; }
  /// Valid until the next frame is processed.
  const ModelState& model() const { return backend_->state(); }
  /// Everything that the next frame needs; the model isn't copied.
  ReconstructionStateView state() const;
  void restore(ReconstructionState state);

 private:
  void reconstruct(const Frame& frame, const Frame* next, const Frame* after, FrameRecord& record);
  bool measure(const Frame& frame, FrameRecord& record);
  bool locate(FrameRecord& record);
  bool locateFrom(const Eigen::Isometry3d& viewpoint, FrameRecord& record);
  bool findAgain(FrameRecord& record);
  bool deform(FrameRecord& record);
  bool confirm(FrameRecord& record);
  void fuse(FrameStatus status, FrameRecord& record);
  void finish(FrameRecord& record);
  void rememberView();
  std::vector<Eigen::Isometry3d> viewpointsToTry() const;

  std::unique_ptr<ReconstructionBackend> backend_;
  GateOptions gate_;
  bool matching_;  // false: the scope is taken as static
  Eigen::Isometry3d world_from_left_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_pose_ = Eigen::Isometry3d::Identity();  // of the last reliable motion
  std::vector<Eigen::Isometry3d> key_views_;
  bool lost_ = false;
  int unfused_frames_ = 0;  // since the last one that was fused
  int searches_ = 0;        // of them, in which the model was sought over the whole image
};

}  // namespace softscope
