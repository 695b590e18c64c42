#include "pipeline/reconstructor.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"

namespace softscope {
namespace {

constexpr std::size_t kViewpointsPerFrame = 3;  // that a lost frame is compared with

bool reject(FrameRecord& record, FrameStatus status, const std::string& reason) {
  record.status = status;
  record.reason = reason;
  return false;
}

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

double degreesBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() * 180 / M_PI;
}

}  // namespace

Reconstructor::Reconstructor(std::unique_ptr<ReconstructionBackend> backend,
                             const ReconstructionOptions& options)
    : backend_(std::move(backend)),
      gate_(options.gate),
      matching_(options.matcher.method != MatcherOptions::kNoMatches) {
  options.validate();
}

FrameRecord Reconstructor::process(const Frame& frame, const std::shared_ptr<const Frame>& next,
                                   const std::shared_ptr<const Frame>& after) {
  FrameRecord record;
  record.frame = frame.index;
  record.time_s = frame.time_s;
  try {
    reconstruct(frame, next, after, record);
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

/// Without fusion, the scope and the tracked points keep their last positions.
void Reconstructor::finish(FrameRecord& record) {
  record.world_from_left = world_from_left_;
  FrameOutcome outcome = backend_->finish(world_from_left_);
  record.fusion = outcome.fusion;
  record.points = outcome.fusion.points;
  record.tracked = std::move(outcome.tracked);
  record.times = std::move(outcome.times);
  unfused_frames_ = record.fused() ? 0 : unfused_frames_ + 1;
  if (record.fused()) searches_ = 0;
  if (record.fused()) return;
  for (TrackedPosition& point : record.tracked)
    point = {point.id, point.position_mm, false, kUnknown};
}

// Song et al. 2018, section III, in its order: depth,
// visible model, matches, rigid pose, warp field, fusion.
void Reconstructor::reconstruct(const Frame& frame, const std::shared_ptr<const Frame>& next,
                                const std::shared_ptr<const Frame>& after, FrameRecord& record) {
  const bool measured = measure(frame, record);
  if (next != nullptr) backend_->prepare(next, after);
  if (!measured) return;
  if (backend_->empty()) return fuse(FrameStatus::kStarted, record);
  const bool was_lost = lost_;
  const Eigen::Isometry3d before = world_from_left_;
  const bool followed = locate(record);
  if (!followed && !relocalise(record)) return;
  if (!deform(record) || !confirm(record)) {
    backend_->rejectWarp();
    world_from_left_ = before;
    lost_ = was_lost;
    return;
  }
  scope_moves_ = !record.pose.scope_static;
  if (scope_moves_) reference_pose_ = world_from_left_;
  fuse(followed ? FrameStatus::kFused : FrameStatus::kRecovered, record);
}

bool Reconstructor::measure(const Frame& frame, FrameRecord& record) {
  record.depth = backend_->measure(frame);
  if (record.depth.measured_px > 0 && record.depth.coverage() >= gate_.min_coverage) return true;
  return reject(record, FrameStatus::kSkippedDepth,
                text("depth on ", 100 * record.depth.coverage(), " % of the tissue, but ",
                     100 * gate_.min_coverage, " % are needed"));
}

bool Reconstructor::locate(FrameRecord& record) {
  return !lost_ && locateFrom(world_from_left_, record);
}

bool Reconstructor::locateFrom(const Eigen::Isometry3d& viewpoint, FrameRecord& record) {
  const LocateSummary found =
      backend_->locate(viewpoint, world_from_left_, reference_pose_, scopeBefore());
  record.matches = found.matches;
  record.pose = found.pose;
  if (!matching_) {
    record.pose.found = true;
    record.pose.world_from_left = world_from_left_;
  }
  if (record.pose.found) world_from_left_ = record.pose.world_from_left;
  return record.pose.found;
}

ScopeBefore Reconstructor::scopeBefore() const {
  if (unfused_frames_ > 0) return ScopeBefore::kUnknown;
  return scope_moves_ ? ScopeBefore::kMoving : ScopeBefore::kStatic;
}

// After a loss, the model is searched in the whole image, then
// again from the pose found, for matches that the warp can use.
bool Reconstructor::relocalise(FrameRecord& record) {
  lost_ = true;
  const RigidPose rough = backend_->relocalise(viewpointsToTry());
  ++searches_;
  if (!rough.found)
    return reject(record, FrameStatus::kLost,
                  text("no view of the model matches the image: ", rough.failure));
  if (!locateFrom(rough.target_from_source, record))
    return reject(record, FrameStatus::kLost,
                  text("found, but not confirmed: ", record.pose.failure));
  lost_ = false;
  return true;
}

/// The last pose and the key views, latest first. Each frame
/// that stays lost continues where the previous one stopped.
std::vector<Eigen::Isometry3d> Reconstructor::viewpointsToTry() const {
  std::vector<Eigen::Isometry3d> all{world_from_left_};
  all.insert(all.end(), key_views_.rbegin(), key_views_.rend());
  const std::size_t count = std::min(kViewpointsPerFrame, all.size());
  const std::size_t first = static_cast<std::size_t>(searches_) * count % all.size();
  std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
  all.resize(count);
  return all;
}

bool Reconstructor::deform(FrameRecord& record) {
  record.warp = backend_->findWarp(world_from_left_);
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
  record.evidence = backend_->confirm(world_from_left_);
  const ViewEvidence& view = record.evidence.view;
  if (view.agreement() >= gate_.min_confidence) return true;
  return reject(record, FrameStatus::kUnconfirmed,
                text("from the pose that was found, the model's depth agrees with the frame on ",
                     100 * view.depth_share, " % of the pixels and its image in ",
                     100 * view.image_share, " % of the blocks (11 % by chance)"));
}

void Reconstructor::fuse(FrameStatus status, FrameRecord& record) {
  backend_->fuse(world_from_left_);
  record.status = status;
  rememberView();
}

void Reconstructor::rememberView() {
  for (const Eigen::Isometry3d& view : key_views_)
    if ((view.translation() - world_from_left_.translation()).norm() < gate_.kKeyViewStepMm &&
        degreesBetween(view, world_from_left_) < gate_.kKeyViewStepDeg)
      return;
  key_views_.push_back(world_from_left_);
  if (key_views_.size() > static_cast<std::size_t>(gate_.kMaxKeyViews))
    key_views_.erase(key_views_.begin());
}

ReconstructionStateView Reconstructor::state() const {
  return {backend_->state(), world_from_left_, reference_pose_, key_views_, lost_,
          scope_moves_,      unfused_frames_,  searches_};
}

void Reconstructor::restore(ReconstructionState state) {
  backend_->restore(std::move(state.model));
  world_from_left_ = state.world_from_left;
  reference_pose_ = state.reference_pose;
  key_views_ = std::move(state.key_views);
  lost_ = state.lost;
  scope_moves_ = state.scope_moves;
  unfused_frames_ = state.unfused_frames;
  searches_ = state.searches;
}

}  // namespace softscope
