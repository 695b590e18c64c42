#include "pipeline/reconstructor.h"

#include <sstream>
#include <utility>

#include "core/error.h"

namespace softscope {
namespace {

// Of a frame that two maps show, with the one that was left; until then, each goes on alone.
constexpr double kLeastAgreement = 0.85;
constexpr double kMostSigmaDeg = 1;

bool reject(FrameRecord& record, FrameStatus status, const std::string& reason) {
  record.status = status;
  record.reason = reason;
  return false;
}

/// Of a record, what the stages before the model give.
FrameRecord measured(const FrameRecord& record) {
  FrameRecord kept;
  kept.frame = record.frame;
  kept.time_s = record.time_s;
  kept.depth = record.depth;
  return kept;
}

bool isAnything(const FrameRecord& /*found*/) { return true; }

bool isBeyondDoubt(const FrameRecord& found) {
  return found.evidence.view.agreement() >= kLeastAgreement &&
         found.pose.sigma_deg <= kMostSigmaDeg;
}

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

}  // namespace

Reconstructor::Reconstructor(std::unique_ptr<ReconstructionBackend> backend,
                             const ReconstructionOptions& options)
    : backend_(std::move(backend)),
      gate_(options.gate),
      matching_(options.matcher.method != MatcherOptions::kNoMatches),
      poses_have_sigma_(matching_ && options.refine_pose.iterations > 0) {
  options.validate();
}

FrameRecord Reconstructor::process(const Frame& frame, const UpcomingFrames& upcoming) {
  FrameRecord record;
  record.frame = frame.index;
  record.time_s = frame.time_s;
  try {
    reconstruct(frame, upcoming, record);
  } catch (const InputError& error) {
    reject(record, FrameStatus::kUnreadable, error.what());
  }
  finish(record);
  return record;
}

FrameRecord Reconstructor::skip(int index, const std::string& reason, double time_s,
                                FrameStatus status) {
  FrameRecord record;
  record.frame = index;
  record.time_s = time_s;
  reject(record, status, reason);
  finish(record);
  return record;
}

/// Without fusion, the scope and the tracked points keep their last positions; in the world of
/// another map, those of the points are unknown.
void Reconstructor::finish(FrameRecord& record) {
  record.world_from_left = scope_.world_from_left;
  record.map = scope_.map;
  FrameOutcome outcome = backend_->finish(scope_.world_from_left);
  record.fusion = outcome.fusion;
  record.points = outcome.fusion.points;
  record.tracked = std::move(outcome.tracked);
  record.precise_tracks_share = preciseShare(record.tracked);
  record.times = std::move(outcome.times);
  if (const MaterialPoints* elsewhere = others_.tracked(); elsewhere != nullptr)
    for (const MaterialPoints::Point& point : elsewhere->points)
      record.tracked.push_back({point.id});
  scope_.unfused_frames = record.fused() ? 0 : scope_.unfused_frames + 1;
  if (record.fused()) scope_.searches = 0;
  if (record.fused()) return;
  for (TrackedPosition& point : record.tracked)
    point = {point.id, point.position_mm, false, kUnknown};
}

// Song et al. 2018, section III, in its order: depth,
// visible model, matches, rigid pose, warp field, fusion.
void Reconstructor::reconstruct(const Frame& frame, const UpcomingFrames& upcoming,
                                FrameRecord& record) {
  const bool has_depth = measure(frame, record);
  backend_->prepare(upcoming);
  if (!has_depth) return;
  if (backend_->empty()) return begin(record);
  if (update(record)) return join(record);
  if (enterOther(ScopeState::kViewpointsPerFrame, isAnything, record))
    return others_.add(others_.take());
  if (scope_.lost && scope_.isSearched() && backend_->showsTissue()) begin(record);
}

/// Seen from the last pose, or at it where matches determine none; else from wherever in the model
/// the frame is recognised.
bool Reconstructor::update(FrameRecord& record) {
  const Eigen::Isometry3d last = scope_.world_from_left;
  if (locate(record) ? explain(record) : assume(record)) {
    fuse(scope_.lost ? FrameStatus::kRecovered : FrameStatus::kFused, record);
    return true;
  }
  if (!matching_) return false;
  FrameRecord found = measured(record);
  scope_.world_from_left = last;
  if (relocalise(found) && explain(found)) {
    record = found;
    fuse(FrameStatus::kRecovered, record);
    return true;
  }
  scope_.world_from_left = last;
  if (record.pose.found) return false;  // in doubt: the next frame is sought from the last pose
  scope_.lost = true;
  record = found;
  return false;
}

/// The warp, and the evidence for it.
bool Reconstructor::explain(FrameRecord& record) {
  if (deform(record) && confirm(record)) return true;
  backend_->rejectWarp();
  return false;
}

/// The scope keeps its last pose, which matches neither give nor deny, if the warped model then
/// agrees with the frame in most places. A motion of it that the warp can take up is the tissue's.
bool Reconstructor::assume(FrameRecord& record) {
  FrameRecord assumed = measured(record);
  assumed.matches = record.matches;
  if (explain(assumed)) {
    const ViewEvidence& view = assumed.evidence.view;
    if (view.agreement() >= GateOptions::kMinAssumedAgreement &&
        view.blocks >= GateOptions::kMinAssumedBlocks) {
      record = assumed;
      return true;
    }
    backend_->rejectWarp();
  }
  return false;
}

bool Reconstructor::measure(const Frame& frame, FrameRecord& record) {
  record.depth = backend_->measure(frame);
  if (record.depth.measured_px > 0 && record.depth.coverage() >= gate_.min_coverage) return true;
  return reject(record, FrameStatus::kSkippedDepth,
                text("depth on ", 100 * record.depth.coverage(), " % of the tissue, but ",
                     100 * gate_.min_coverage, " % are needed"));
}

bool Reconstructor::locate(FrameRecord& record) {
  return !scope_.lost && locateFrom(scope_.world_from_left, record);
}

/// The scope has the pose that was found if its matches determine one.
bool Reconstructor::locateFrom(const Eigen::Isometry3d& viewpoint, FrameRecord& record) {
  const LocateSummary found =
      backend_->locate(viewpoint, scope_.world_from_left, scope_.reference_pose, scopeBefore());
  record.matches = found.matches;
  record.pose = found.pose;
  if (!matching_) {
    record.pose.found = true;
    record.pose.world_from_left = scope_.world_from_left;
  }
  if (!record.pose.found) return false;
  if (poses_have_sigma_ && !(record.pose.sigma_deg <= GateOptions::kMaxPoseSigmaDeg))
    return reject(record, FrameStatus::kUnconfirmed,
                  text(record.pose.inliers, " matches do not determine the scope's pose: sigma ",
                       record.pose.sigma_deg, " deg, at most ", GateOptions::kMaxPoseSigmaDeg,
                       " are needed"));
  scope_.world_from_left = record.pose.world_from_left;
  return true;
}

ScopeBefore Reconstructor::scopeBefore() const {
  if (scope_.unfused_frames > 0) return ScopeBefore::kUnclear;
  return scope_.scope_moves ? ScopeBefore::kMoving : ScopeBefore::kStatic;
}

// After a loss, the model is searched in the whole image, then
// again from the pose found, for matches that the warp can use.
bool Reconstructor::relocalise(FrameRecord& record) {
  backend_->activateAll();
  const RigidPose rough = backend_->relocalise(
      backend_->state().model, scope_.viewpointsToTry(ScopeState::kViewpointsPerFrame));
  ++scope_.searches;
  if (!rough.found)
    return reject(record, FrameStatus::kLost,
                  text("no view of the model matches the image: ", rough.failure));
  if (locateFrom(rough.target_from_source, record)) return true;
  if (record.pose.found) return false;
  return reject(record, FrameStatus::kLost,
                text("found, but not confirmed: ", record.pose.failure));
}

bool Reconstructor::deform(FrameRecord& record) {
  record.warp = backend_->findWarp(scope_.world_from_left, scopeBefore());
  const DeformSummary& solver = record.warp.solver;
  const double explained =
      record.warp.in_sight > 0 ? double(solver.points_after) / record.warp.in_sight : 0;
  const double max_residual_mm = record.depth.limit_scale * gate_.max_residual_mm;
  if (solver.reason != StopReason::kNotFinite && explained >= gate_.min_explained &&
      solver.data_mean_mm_after <= max_residual_mm) {
    backend_->acceptWarp(!record.pose.keeps_shape);
    return true;
  }
  return reject(record, FrameStatus::kSkippedResidual,
                text("the warp (", toString(solver.reason), ") explains ", 100 * explained,
                     " % of the points in sight, to ", solver.data_mean_mm_after,
                     " mm on average; needed are ", 100 * gate_.min_explained, " % and ",
                     max_residual_mm, " mm"));
}

bool Reconstructor::confirm(FrameRecord& record) {
  record.evidence = backend_->confirm(scope_.world_from_left);
  const ViewEvidence& view = record.evidence.view;
  if (view.agreement() >= gate_.min_confidence) return true;
  const std::string pose = "from the pose that was found, ";
  if (view.blocks == 0)
    return reject(record, FrameStatus::kUnconfirmed,
                  pose + "the model has no texture to compare with the image");
  return reject(record, FrameStatus::kUnconfirmed,
                text(pose, "the model's depth agrees with the frame on ", 100 * view.depth_share,
                     " % of the pixels and its image in ", 100 * view.image_share,
                     " % of the blocks (11 % by chance)"));
}

void Reconstructor::fuse(FrameStatus status, FrameRecord& record) {
  backend_->fuse(scope_.world_from_left);
  record.status = status;
  scope_.lost = false;
  if (record.pose.found) scope_.scope_moves = !record.pose.scope_static;
  if (scope_.scope_moves) scope_.reference_pose = scope_.world_from_left;
  ++scope_.fused_frames;
  scope_.remember(scope_.world_from_left);
}

/// A model begins with the frame: the first, or that of another place, whose world has the pose
/// where the scope was lost.
void Reconstructor::begin(FrameRecord& record) {
  if (!backend_->empty()) {
    backend_->activateAll();
    others_.add({backend_->state(), scope_});
    backend_->restore(ModelState());
  }
  const Eigen::Isometry3d here = scope_.world_from_left;
  scope_ = ScopeState();
  scope_.map = maps_++;
  scope_.world_from_left = scope_.reference_pose = here;
  record = measured(record);
  fuse(FrameStatus::kStarted, record);
}

/// Goes on in another map if the frame is recognised there.
bool Reconstructor::enterOther(std::size_t viewpoints, bool (*accepts)(const FrameRecord&),
                               FrameRecord& record) {
  if (others_.empty()) return false;
  Submap& other = others_.next();
  const RigidPose rough =
      backend_->relocalise(other.model.model, other.scope.viewpointsToTry(viewpoints));
  ++other.scope.searches;
  if (!rough.found) return false;
  exchange(&other);
  const ScopeState before = scope_;
  const auto leave = [&] {
    backend_->rejectWarp();
    scope_ = before;
    exchange(&other);
  };
  FrameRecord found = measured(record);
  try {
    if (locateFrom(rough.target_from_source, found) && explain(found) && accepts(found)) {
      fuse(FrameStatus::kRecovered, found);
      record = found;
      return true;
    }
  } catch (const BackendError&) {
    leave();
    throw;
  }
  leave();
  return false;
}

/// Two maps that both show the frame become one, in the world of the older.
void Reconstructor::join(FrameRecord& record) {
  FrameRecord found = record;
  try {
    if (!enterOther(1, isBeyondDoubt, found)) return;
  } catch (const BackendError&) {
    return;  // this frame is fused; the next one meets the failure
  }
  Submap newer = others_.take();
  if (newer.scope.map < scope_.map)
    exchange(&newer);
  else
    record = found;
  const Eigen::Isometry3d into_from =
      scope_.world_from_left * newer.scope.world_from_left.inverse();
  backend_->add(newer.model, into_from);
  for (const Eigen::Isometry3d& view : newer.scope.key_views) scope_.remember(into_from * view);
  scope_.fused_frames += newer.scope.fused_frames;
  record.join = MapJoin{newer.scope.map, scope_.map, into_from};
}

/// Takes up another map; `other` is what was in use then.
void Reconstructor::exchange(Submap* other) {
  backend_->activateAll();
  ModelState model = backend_->state();
  backend_->restore(std::exchange(other->model, {}));
  other->model = std::move(model);
  std::swap(scope_, other->scope);
}

ReconstructionStateView Reconstructor::state() const {
  return {backend_->state(), scope_, others_.all(), maps_};
}

void Reconstructor::restore(ReconstructionState state) {
  backend_->restore(std::move(state.model));
  scope_ = std::move(state.scope);
  others_.restore(std::move(state.others));
  maps_ = state.maps;
}

}  // namespace softscope
