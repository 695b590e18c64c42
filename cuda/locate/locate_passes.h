// cuda/locate/locate_passes.h: matched points from a model on the device, for any executor.
#pragma once

#include "cuda/locate/locate_lift.h"
#include "cuda/match/match_passes.h"
#include "cuda/view/view_passes.h"
#include "features/lift_matches.h"

namespace softscope::cuda {

/// Arrays of view, matching and lift.
struct LocateLayout {
  LocateLayout(Arena& arena, const MatcherOptions& matcher, int width, int height,
               int point_capacity)
      : view(arena, width, height, point_capacity), match(arena, matcher, width, height) {
    live_depth = arena.image<float>(width, height);
    live_sigma = arena.image<float>(width, height);
    inputs = arena.array<LiftInputs>(1);
    lifted = arena.array<LiftSlot>(match.slot_count);
    found.counts = arena.array<int>(match.slot_count);
    found.starts = arena.array<int>(match.slot_count);
    found.rows = static_cast<int>(match.slot_count);
    list = arena.array<LiftSlot>(match.slot_count);
    lifted_count = arena.array<int>(1);
  }

  ViewLayout view;
  MatchLayout match;
  View<float> live_depth, live_sigma;
  LiftInputs* inputs;
  LiftSlot* lifted;
  PlaceBits found{};  // per match; no bits
  LiftSlot* list;
  int* lifted_count;
};

template <class Executor>
class LocatePasses {
 public:
  LocatePasses(Executor& executor, const LocateLayout& layout)
      : executor_(executor),
        layout_(layout),
        view_(executor, layout.view),
        match_(executor, layout.match) {}

  /// With `own_gray`, the grey image of the model was uploaded and has no anchor.
  void locate(const ModelViewOptions& options, bool own_gray) {
    view_.draw(options);
    const ViewImages& view = layout_.view.images;
    const MatchScale& full = layout_.match.levels.front();
    const ViewToMatchBody to_match{readOnly(view.colour),
                                   readOnly(view.anchor),
                                   readOnly(view.point),
                                   full.gray[0],
                                   full.gray[2],
                                   layout_.match.mask[0],
                                   own_gray};
    const PixelKernel<ViewToMatchBody> kernel{to_match, full.width, full.height};
    executor_.launch("view to match", kernel, kernel.grid());
    match_.match();
    lift();
  }

 private:
  void lift() {
    const int capacity = static_cast<int>(layout_.match.slot_count);
    const LiftKernel lift{layout_.match.list,
                          layout_.match.match_count,
                          capacity,
                          readOnly(layout_.view.images.depth),
                          readOnly(layout_.live_depth),
                          readOnly(layout_.live_sigma),
                          readOnly(layout_.view.images.point),
                          layout_.inputs,
                          layout_.lifted,
                          layout_.found.counts};
    executor_.launch("lift", lift, lift.blocks());
    executor_.launch("starts", RowStartsKernel{layout_.found, layout_.lifted_count}, Grid{});
    const SlotKernel<KeepLiftedBody> keep{
        {layout_.lifted, layout_.found.counts, layout_.found.starts, layout_.list}, capacity};
    executor_.launch("keep lifted", keep, keep.blocks());
    executor_.mark("lift");
  }

  Executor& executor_;
  const LocateLayout& layout_;
  ViewPasses<Executor> view_;
  MatchPasses<Executor> match_;
};

inline std::vector<LiftedMatch> liftedMatches(const LiftSlot* list, int count) {
  std::vector<LiftedMatch> matches;
  matches.reserve(static_cast<std::size_t>(count));
  for (const LiftSlot* slot = list; slot != list + count; ++slot) {
    LiftedMatch match;
    match.model_point = slot->model_point;
    match.source_world_mm = Eigen::Map<const Eigen::Vector3f>(slot->source_world_mm);
    match.target_left_mm = Eigen::Map<const Eigen::Vector3f>(slot->target_left_mm);
    match.across_mm = slot->across_mm;
    match.along_mm = slot->along_mm;
    match.similarity = slot->similarity;
    match.match = slot->match;
    matches.push_back(match);
  }
  return matches;
}

}  // namespace softscope::cuda
