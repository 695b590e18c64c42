// src/pipeline/reconstructor.h: the method, frame by frame.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/frame_record.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// State of a run that is needed to resume it.
template <class Model>
struct StateOf {
  Model model;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_pose = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Isometry3d> key_views;
  bool lost = false;
  bool scope_moves = false;  // in the last fused frame
  int unfused_frames = 0;    // since the last fused one
  int searches = 0;          // searches over the whole image among them
};
using ReconstructionState = StateOf<ModelState>;
/// Refers to the model of a Reconstructor: valid until its next frame is processed.
using ReconstructionStateView = StateOf<const ModelState&>;

/// Owns the order of the stages; the back end owns their data.
class Reconstructor {
 public:
  Reconstructor(std::unique_ptr<ReconstructionBackend> backend,
                const ReconstructionOptions& options);

  /// One frame, from images to the updated model. A rejected frame leaves the model
  /// unchanged; the record has the reason. `next` and `after`: the two following frames, if
  /// known already, so that their depth can start in parallel. The model does not depend on them.
  FrameRecord process(const Frame& frame, const std::shared_ptr<const Frame>& next = nullptr,
                      const std::shared_ptr<const Frame>& after = nullptr);

  /// A frame that is unreadable or has no partner.
  FrameRecord skip(int index, const std::string& reason, double time_s = kUnknown,
                   FrameStatus status = FrameStatus::kUnreadable);

  /// Before the first frame.
  void track(const std::vector<TrackSeed>& seeds) { backend_->track(seeds); }

  const ReconstructionBackend& backend() const { return *backend_; }
  /// Valid until the next frame is processed.
  const ModelState& model() const { return backend_->state(); }
  /// State needed for the next frame; the model is not copied.
  ReconstructionStateView state() const;
  void restore(ReconstructionState state);

 private:
  void reconstruct(const Frame& frame, const std::shared_ptr<const Frame>& next,
                   const std::shared_ptr<const Frame>& after, FrameRecord& record);
  bool measure(const Frame& frame, FrameRecord& record);
  bool locate(FrameRecord& record);
  bool locateFrom(const Eigen::Isometry3d& viewpoint, FrameRecord& record);
  bool relocalise(FrameRecord& record);
  ScopeBefore scopeBefore() const;
  bool deform(FrameRecord& record);
  bool confirm(FrameRecord& record);
  void fuse(FrameStatus status, FrameRecord& record);
  void finish(FrameRecord& record);
  void rememberView();
  std::vector<Eigen::Isometry3d> viewpointsToTry() const;

  std::unique_ptr<ReconstructionBackend> backend_;
  GateOptions gate_;
  bool matching_;  // false: the scope is treated as static
  Eigen::Isometry3d world_from_left_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_pose_ = Eigen::Isometry3d::Identity();  // of the last reliable motion
  std::vector<Eigen::Isometry3d> key_views_;
  bool lost_ = false;
  bool scope_moves_ = false;  // in the last fused frame
  int unfused_frames_ = 0;    // since the last fused one
  int searches_ = 0;          // searches over the whole image among them
};

}  // namespace softscope
