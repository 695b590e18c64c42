// src/pipeline/reconstructor.h: the method, frame by frame.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/frame_record.h"
#include "pipeline/options/reconstruction_options.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/submaps.h"

namespace softscope {

/// State of a run that is needed to resume it.
template <class Model, class Others>
struct StateOf {
  Model model;
  ScopeState scope;
  Others others;  // the maps that are not in use
  int maps = 0;   // begun so far
};
using ReconstructionState = StateOf<ModelState, std::vector<Submap>>;
/// Refers to the models of a Reconstructor: valid until its next frame is processed.
using ReconstructionStateView = StateOf<const ModelState&, const std::vector<Submap>&>;

/// Owns the order of the stages; the back end owns their data.
class Reconstructor {
 public:
  Reconstructor(std::unique_ptr<ReconstructionBackend> backend,
                const ReconstructionOptions& options);

  /// One frame, from images to the updated model. A rejected frame leaves the model
  /// unchanged; the record has the reason. `upcoming`: the following frames, if known already, so
  /// that their depth can start in parallel. The model does not depend on them.
  FrameRecord process(const Frame& frame, const UpcomingFrames& upcoming = {});

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
  void reconstruct(const Frame& frame, const UpcomingFrames& upcoming, FrameRecord& record);
  bool measure(const Frame& frame, FrameRecord& record);
  bool update(FrameRecord& record);
  bool locate(FrameRecord& record);
  bool locateFrom(const Eigen::Isometry3d& viewpoint, FrameRecord& record);
  bool relocalise(FrameRecord& record);
  ScopeBefore scopeBefore() const;
  bool assume(FrameRecord& record);
  bool explain(FrameRecord& record);
  bool deform(FrameRecord& record);
  bool confirm(FrameRecord& record);
  void fuse(FrameStatus status, FrameRecord& record);
  void finish(FrameRecord& record);

  void begin(FrameRecord& record);
  bool enterOther(std::size_t viewpoints, bool (*accepts)(const FrameRecord&), FrameRecord& record);
  void join(FrameRecord& record);
  void exchange(Submap* other);

  std::unique_ptr<ReconstructionBackend> backend_;
  GateOptions gate_;
  bool matching_;          // false: the scope is treated as static
  bool poses_have_sigma_;  // false: those of RANSAC are taken as they are
  ScopeState scope_;       // in the map in use
  Submaps others_;
  int maps_ = 0;  // begun so far
};

}  // namespace softscope
