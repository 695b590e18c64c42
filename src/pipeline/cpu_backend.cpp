#include "pipeline/cpu_backend.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/median.h"
#include "core/parallel.h"
#include "deform/energy/surface_target.h"
#include "deform/solver/local_solver.h"
#include "fusion/visibility.h"
#include "pipeline/frame/frame_ahead.h"
#include "pipeline/frame/key_point_matches.h"
#include "pipeline/frame/match_ahead.h"
#include "pipeline/frame/pose_stage.h"
#include "pipeline/frame/relocaliser.h"
#include "pipeline/frame/tissue_colour.h"
#include "pipeline/model/accepted_warp.h"
#include "pipeline/model/active_region.h"
#include "pipeline/model/graph_ahead.h"
#include "pipeline/model/united_models.h"
#include "pipeline/tracks/track_pictures.h"
#include "pipeline/tracks/track_sight.h"

namespace softscope {
namespace {

class CpuBackend : public ReconstructionBackend {
 public:
  CpuBackend(const StereoCalibration& calibration, const ReconstructionOptions& options,
             const BackendParts& parts)
      : options_(options),
        name_(parts.name),
        device_(parts.device),
        ahead_from_threads_(parts.ahead_from_threads),
        frames_(std::make_unique<FrameDepth>(calibration, options.depth, parts.makeStereo), options,
                parts.makeSurvey, parts.ahead),
        thread_limit_(parts.thread_limit),
        matching_(parts.makeMatching(options, rig())),
        pose_(rig(), options.refine_pose, parts.makePoseSearch()),
        solver_(makeLocalSolver(parts.makeSolver(options.deform), options.graph.node_spacing_mm)),
        comparer_(parts.makeComparer(rig())),
        updater_(parts.makeUpdater(rig())),
        surface_(parts.makeSurface()),
        looks_(parts.makeLooks()),
        warp_(parts.makeWarp()) {
    options.validate();
  }

  std::string name() const override { return name_; }
  std::string device() const override { return device_; }
  const RectifiedRig& rig() const override { return frames_.depth().rig(); }
  bool empty() const override { return state_.model.empty(); }
  void activateAll() override {
    if (!state_.inactive.empty()) changePoints([&] { softscope::activateAll(&state_); });
  }
  const ModelState& state() const override {
    updater_->fetch(&state_.memory);
    return state_;
  }
  void restore(ModelState state) override {
    replaceState([&] { state_ = std::move(state); });
    if (!empty()) seeds_.clear();
  }
  void add(const ModelState& other, const Eigen::Isometry3d& world_from_other) override {
    replaceState([&] { uniteModels(other, world_from_other, &state_); });
  }

  void prepare(const UpcomingFrames& upcoming) override {
    if (worksAhead()) frames_.prepare(upcoming);
  }
  DepthSummary measure(const Frame& frame) override;
  LocateSummary locate(const Eigen::Isometry3d& viewed_from, const Eigen::Isometry3d& last,
                       const Eigen::Isometry3d& reference, ScopeBefore before) override;
  RigidPose relocalise(const PointModel& model,
                       const std::vector<Eigen::Isometry3d>& viewpoints) override;
  bool showsTissue() const override {
    return isAsRed(frame_.measured.left, frame_.measured.depth.depth_mm, state_.model);
  }
  WarpSummary findWarp(const Eigen::Isometry3d& world_from_left, ScopeBefore before) override;
  void acceptWarp(bool is_reference) override;
  EvidenceSummary confirm(const Eigen::Isometry3d& world_from_left) override;
  void rejectWarp() override;
  void fuse(const Eigen::Isometry3d& world_from_left) override;
  FrameOutcome finish(const Eigen::Isometry3d& world_from_left) override;
  void track(const std::vector<TrackSeed>& seeds) override { seeds_ = seeds; }

 private:
  const PinholeCamera& left() const { return rig().left; }
  bool worksAhead() const { return threadCount() >= ahead_from_threads_; }
  /// The frame at hand, with its normals.
  Observation observed(const Eigen::Isometry3d& world_from_left) {
    frames_.complete(&frame_);
    return observationOf(frame_, left(), world_from_left);
  }
  GrayImage seenFrom(const Eigen::Isometry3d& world_from_left) const;
  void grow();
  bool tracks() const { return !state_.tracked.points.empty(); }
  void seedTracks(const Eigen::Isometry3d& world_from_left);
  void alignTracks(const Eigen::Isometry3d& world_from_left);
  void settleTracks(const IndexMap& index_map, bool first,
                    const Eigen::Isometry3d& world_from_left);
  void measureError(const Observation& observation);
  void endAlignment() {
    if (aligning_.valid()) aligning_.get();
  }

  ReconstructionOptions options_;
  std::string name_, device_;
  int ahead_from_threads_;
  FrameAhead frames_;
  std::shared_ptr<ThreadLimit> thread_limit_;
  MatchAhead matching_;
  PoseStage pose_;
  std::unique_ptr<DeformSolver> solver_;

  mutable ModelState state_;      // its memory may lie on a device until state() is called
  std::vector<TrackSeed> seeds_;  // until the first model begins with them
  GraphAhead growth_;  // of the model and the graph as fuse() left them; ends before they do
  bool is_grown_ = false;

  template <class Work>
  void orRejectWarp(const Work& work);
  template <class Work>
  void replaceState(const Work& work) {
    changePoints(work);
    updater_->changed(kWholeModel);
    looks_->changed();
  }
  /// What was begun ahead is dropped.
  template <class Work>
  void changePoints(const Work& work) {
    growth_.drop();
    matching_.drop();
    work();
    updater_->changed(kModelPoints);
  }
  ActiveRegion regionOf(const Eigen::Isometry3d& world_from_left) const {
    return {left(), world_from_left, options_.graph.node_spacing_mm};
  }
  void beginNext(const Eigen::Isometry3d& world_from_left);

  // Of the frame at hand.
  FrameView frame_;
  std::unique_ptr<FrameComparer> comparer_;
  std::unique_ptr<ModelUpdater> updater_;
  std::unique_ptr<SurfaceSearch> surface_;
  std::unique_ptr<LookStage> looks_;
  AcceptedWarp warp_;
  std::vector<LiftedMatch> matches_;
  std::optional<ModelComparison> comparison_;  // with the warped model
  FusionSummary fused_;
  StageClock clock_;
  TrackPictures pictures_{&frame_, &frames_};  // ends before the frame
  std::future<void> aligning_;  // the tracked points, from confirm() to fuse(); ends before all
};

DepthSummary CpuBackend::measure(const Frame& frame) {
  pictures_.end();
  clock_ = StageClock();
  matches_.clear();
  comparison_.reset();
  pose_.forget();
  frame_ = frames_.measure(frame, &clock_);
  if (tracks() && worksAhead()) pictures_.prepare(looks_->takesPictures());
  return frame_.summary;
}

/// The last image, where it is kept and was seen from there: for comparison it is matched in place
/// of the drawn model. Else empty.
GrayImage CpuBackend::seenFrom(const Eigen::Isometry3d& world_from_left) const {
  const LastPicture& last = state_.last;
  const bool from_there = world_from_left.matrix() == last.world_from_left.matrix();
  return from_there && !last.left.empty() ? toGray(last.left) : GrayImage();
}

LocateSummary CpuBackend::locate(const Eigen::Isometry3d& viewed_from,
                                 const Eigen::Isometry3d& last, const Eigen::Isometry3d& reference,
                                 ScopeBefore before) {
  ModelMatches found =
      matching_.match(state_.model, viewed_from, seenFrom(viewed_from), frame_, &clock_);
  matches_ = std::move(found.lifted);
  LocateSummary summary;
  summary.matches = {static_cast<int>(found.pixels.size()), static_cast<int>(matches_.size())};
  summary.pose =
      pose_.estimate(matches_, frame_.pose, state_.model, state_.graph, {last, reference, before});
  clock_.lap("pose");
  return summary;
}

RigidPose CpuBackend::relocalise(const PointModel& model,
                                 const std::vector<Eigen::Isometry3d>& viewpoints) {
  RigidPose pose = softscope::relocalise(model, viewpoints, frame_.live, frame_.measured, left(),
                                         options_.model_view, frame_.pose);
  clock_.lap("match");
  return pose;
}

WarpSummary CpuBackend::findWarp(const Eigen::Isometry3d& world_from_left, ScopeBefore before) {
  is_grown_ = false;
  if (!growth_.canWait(state_.model)) grow();
  if (const ActiveRegion region = regionOf(world_from_left); region.reachesInactive(state_)) {
    if (!is_grown_) grow();
    changePoints([&] { region.activate(&state_); });
  }
  clock_.lap("graph");
  std::vector<std::int32_t> visible;
  DeformObservation seen;
  const Observation frame = observed(world_from_left);
  parallelInvoke(
      [&] {
        visible =
            comparer_->visiblePoints(state_.model, frame, frame_.states, frame_.fusion.visibility);
      },
      [&] {
        if (options_.deform.correspondence_weight > 0)
          seen.matches =
              keyPointMatches(matches_, pose_.rigid(), frame_.association, world_from_left);
      });
  seen.visible = &visible;
  const DepthTarget surface(frame.depth, frame.normals, left(), world_from_left.inverse(),
                            frame_.association);
  clock_.lap("visible");
  WarpSummary summary;
  summary.in_sight = static_cast<int>(visible.size());
  summary.nodes = static_cast<int>(state_.graph.size());
  seen.surface = &surface;
  seen.after_gap = before == ScopeBefore::kUnclear;
  growth_.waitForSolver();
  summary.solver = solver_->solve(state_.model, seen, &state_.graph);
  clock_.lap("solve");
  return summary;
}

void CpuBackend::grow() {
  growth_.grow(options_.graph, &state_.model, &state_.graph);
  updater_->changed(kModelBindings);
  is_grown_ = true;
}

void CpuBackend::acceptWarp(bool is_reference) {
  if (!is_grown_) grow();
  orRejectWarp([&] { warp_.apply(updater_.get(), options_.graph.node_spacing_mm, &state_); });
  if (is_reference) state_.graph.since_reference.assign(state_.graph.size(), NodeTransform());
  clock_.lap("warp");
}

/// After the update. If a device fails, this frame is complete without it.
void CpuBackend::measureError(const Observation& observation) {
  try {
    fused_.corrected = comparer_->error(state_.model, observation, frame_.states);
  } catch (const BackendError&) {
    fused_.corrected = CpuFrameComparer().error(state_.model, observation, frame_.states);
  }
}

EvidenceSummary CpuBackend::confirm(const Eigen::Isometry3d& world_from_left) {
  // Nearly every frame is confirmed: what fusion asks first is found beside the evidence, and the
  // tracked points are aligned.
  if (tracks() && worksAhead())
    aligning_ = std::async(std::launch::async, [=] { alignTracks(world_from_left); });
  FrameComparison found;
  orRejectWarp([&] {
    found = comparer_->compare(state_.model, state_.graph, observed(world_from_left), frame_.states,
                               frame_.fusion);
  });
  comparison_ = std::move(found.model);
  clock_.lap("check");
  return {found.predicted, found.view};
}

/// Where the device fails, the model on the host is that of the frame before.
template <class Work>
void CpuBackend::orRejectWarp(const Work& work) {
  try {
    work();
  } catch (const BackendError&) {
    rejectWarp();
    throw;
  }
}

void CpuBackend::rejectWarp() {
  growth_.drop();
  endAlignment();
  comparison_.reset();
  warp_.undo(updater_.get(), &state_);
}

void CpuBackend::fuse(const Eigen::Isometry3d& world_from_left) {
  growth_.drop();
  const Observation observation = observed(world_from_left);
  const bool first = empty();
  if (first) seedTracks(world_from_left);
  if (!comparison_)
    comparison_ =
        compareModel(state_.model, state_.graph, observation, frame_.states, frame_.fusion);
  const ActiveRegion region = regionOf(world_from_left);
  const bool leaves_much =
      options_.deform.node_model == NodeModel::kRigid && region.leavesMuch(state_);
  ModelUpdateSummary update;
  const auto updateModel = [&] {
    update = updater_->update(observation, frame_.states, state_.graph, frame_.fusion, *comparison_,
                              &state_.memory, &state_.model);
    if (!leaves_much) beginNext(world_from_left);
  };
  LastingErrors errors = state_.errors;
  // Neither needs the other.
  orRejectWarp([&] {
    parallelInvoke(updateModel, [&] {
      if (!first && !aligning_.valid()) alignTracks(world_from_left);
      errors.observe(frame_.levelled.get(), observation, state_.graph, frame_.fusion);
    });
  });
  warp_.keep();
  state_.errors = std::move(errors);
  comparison_.reset();
  measureError(observation);
  endAlignment();
  state_.exposure = update.points.gain;
  if (options_.match_last_picture) state_.last = {frame_.measured.left, world_from_left};
  clock_.lap("fuse");
  settleTracks(update.index_map, first, world_from_left);
  if (leaves_much) {
    IndexMap kept;
    changePoints([&] { kept = region.deactivate(&state_); });
    state_.tracked.renumber(kept, state_.model, options_.graph.node_spacing_mm, surface_.get());
    beginNext(world_from_left);
  }
  const int points = static_cast<int>(state_.model.size() + countInactive(state_));
  fused_ = {points,
            update.seen,
            update.points.fused,
            update.insertion.inserted,
            update.points.contradicted,
            fused_.corrected};
  clock_.lap("check");
}

/// Growth of the graph and matches of the next frame, where they can run already.
void CpuBackend::beginNext(const Eigen::Isometry3d& world_from_left) {
  if (worksAhead()) growth_.prepare(options_.graph, state_.model, state_.graph, solver_.get());
  const FrameView* next = options_.match_last_picture ? nullptr : frames_.next();
  if (next != nullptr) matching_.begin(state_.model, world_from_left, *next);
}

/// On the surface of the updated model.
void CpuBackend::settleTracks(const IndexMap& index_map, bool first,
                              const Eigen::Isometry3d& world_from_left) {
  state_.tracked.renumber(index_map, state_.model, options_.graph.node_spacing_mm, surface_.get());
  if (first) {
    state_.tracked.anchor(state_.model, surface_.get());
    if (tracks())
      state_.tracked.look(pictures_.looks(), state_.model, left(), world_from_left,
                          frame_.measured.depth);
  }
  state_.tracked.settle(state_.model, world_from_left.translation(), frame_.summary.limit_scale,
                        surface_.get());
}

FrameOutcome CpuBackend::finish(const Eigen::Isometry3d& world_from_left) {
  FrameOutcome outcome{std::exchange(fused_, {}), {}, clock_.laps()};
  const bool fused = outcome.fusion.points > 0;
  if (tracks()) {
    outcome.tracked =
        TrackSight(frame_, rig()).positions(state_.tracked, world_from_left, pictures_.reliefPx());
    if (fused) state_.tracked.countMeasured(outcome.tracked);
    state_.tracked.hideUnmeasured(&outcome.tracked);
  }
  clock_ = StageClock();
  return outcome;
}

void CpuBackend::seedTracks(const Eigen::Isometry3d& world_from_left) {
  for (const TrackSeed& seed : std::exchange(seeds_, {}))
    state_.tracked.add(seed.id, frames_.depth().rectifier().rectifiedPixel({seed.u_px, seed.v_px}),
                       left(), frame_.measured.depth.depth_mm, world_from_left);
}

void CpuBackend::alignTracks(const Eigen::Isometry3d& world_from_left) {
  if (!tracks()) return;
  const TrackSight sight(frame_, rig());
  state_.tracked.align([&](const auto& sought) { return looks_->find(sought, frame_, &pictures_); },
                       left(), world_from_left, options_.graph.node_spacing_mm,
                       [&](const Eigen::Vector3d& point) { return sight.shows(point); });
}

}  // namespace

std::unique_ptr<ReconstructionBackend> makeCpuBackend(const StereoCalibration& calibration,
                                                      const ReconstructionOptions& options,
                                                      const BackendParts& parts) {
  options.validate();
  return std::make_unique<CpuBackend>(calibration, withSharedQuantities(options), parts);
}

}  // namespace softscope
