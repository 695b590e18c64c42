// cuda/match/match_passes.h: order of the kernels of matching, for any executor.
#pragma once

#include <algorithm>

#include "cuda/device/reset_kernel.h"
#include "cuda/match/match_layout.h"
#include "cuda/match/match_subpixel.h"

namespace softscope::cuda {

/// Matching over a layout: list of matches from images, masks and anchor.
template <class Executor>
class MatchPasses {
 public:
  MatchPasses(Executor& executor, const MatchLayout& layout)
      : executor_(executor), layout_(layout) {}

  void match() {
    prepareImages();
    describe();
    for (std::size_t k = layout_.levels.size(); k-- > 0;) {
      // The coarsest level has few squares with many candidates each.
      if (k + 1 < layout_.levels.size())
        search<32>(layout_.levels[k]);
      else
        search<256>(layout_.levels[k]);
      if (k > 0) predict(layout_.levels[k], layout_.levels[k - 1]);
    }
    refine();
    for (std::size_t k = layout_.levels.size() - 1; k-- > 0;) takeCoarser(k);
    list();
  }

 private:
  const MatcherOptions& options() const { return layout_.options; }
  template <class Body>
  void perElement(const char* name, const Body& body, int width, int height, int depth = 1) {
    const PixelKernel<Body> kernel{body, width, height};
    executor_.launch(name, kernel, kernel.grid(depth));
  }
  template <class Body>
  void perSlot(const char* name, const Body& body, std::size_t count) {
    const SlotKernel<Body> kernel{body, static_cast<int>(count)};
    executor_.launch(name, kernel, kernel.blocks());
  }
  void prepareImages() {
    const MatchScale& full = layout_.levels.front();
    ResetKernel reset{};
    reset.add(layout_.zeroed, layout_.zeroedWords(), 0);
    // The list is copied as a whole.
    reset.add(layout_.list, layout_.slot_count * sizeof(SlotMatch) / 4, 0);
    executor_.launch("reset", reset, reset.blocks());
    perElement("dark in row",
               DarkInRowBody{{readOnly(full.gray[0]), readOnly(full.gray[1])},
                             {layout_.dark_in_row[0], layout_.dark_in_row[1]},
                             options().kDarkestGray,
                             options().kDarkMarginPx},
               full.width, full.height, 2);
    perElement("ignore",
               IgnoreBody{{readOnly(layout_.dark_in_row[0]), readOnly(layout_.dark_in_row[1])},
                          {readOnly(layout_.mask[0]), readOnly(layout_.mask[1])},
                          {full.ignore[0], full.ignore[1]},
                          layout_.inputs,
                          options().kDarkMarginPx},
               full.width, full.height, 2);
    for (std::size_t k = 1; k < layout_.levels.size(); ++k)
      halve(layout_.levels[k - 1], layout_.levels[k]);
    executor_.mark("masks, pyramid");
    if (!isRefined()) return;
    for (const MatchScale& level : layout_.levels) {
      BinomialBody body{{}, {}, layout_.inputs};
      for (int image = 0; image < kMatchImages; ++image) {
        body.gray[image] = readOnly(level.gray[image]);
        body.smooth[image] = level.smooth[image];
      }
      perElement("binomial", body, level.width, level.height, kMatchImages);
    }
    executor_.mark("smooth");
  }
  void halve(const MatchScale& whole, const MatchScale& half) {
    HalveMatchBody body{{}, {}, {}, {}, layout_.inputs};
    for (int image = 0; image < kMatchImages; ++image) {
      body.gray[image] = readOnly(whole.gray[image]);
      body.half_gray[image] = half.gray[image];
    }
    for (int image = 0; image < 2; ++image) {
      body.ignore[image] = readOnly(whole.ignore[image]);
      body.half_ignore[image] = half.ignore[image];
    }
    perElement("halve", body, half.width, half.height, kMatchImages);
  }

  void describe() {
    for (const MatchScale& level : layout_.levels) {
      perElement("wavelets",
                 SurfSquaresBody{{readOnly(level.gray[0]), readOnly(level.gray[1])},
                                 {readOnly(level.ignore[0]), readOnly(level.ignore[1])},
                                 {level.squares[0], level.squares[1]}},
                 level.squares[0].columns, level.squares[0].rows, 2);
      const DescribeKernel kernel{
          {level.squares[0], level.squares[1]}, {level.nodes[0], level.nodes[1]}, layout_.surf};
      executor_.launch("describe", kernel, kernel.blocks());
    }
    executor_.mark("descriptors");
  }

  bool isRefined() const { return options().subpixel.method == "gauss-newton"; }

  template <int kLanes>
  void search(const MatchScale& level) {
    const SearchKernel<kLanes> kernel{level.nodes[0],
                                      level.nodes[1],
                                      level.predicted(),
                                      level.reach,
                                      layout_.surf.first_px,
                                      static_cast<float>(options().kMaxRatio),
                                      0.5f * static_cast<float>(options().dense_surf.kGridPx),
                                      !isRefined(),
                                      layout_.distances,
                                      level.rough};
    executor_.launch("search", kernel, kernel.blocks());
    executor_.mark("search");
  }

  void refine() {
    if (!isRefined()) {
      for (const MatchScale& level : layout_.levels)
        perSlot("copy", CopyMatchesBody{level.rough, level.kept}, level.slotCount());
      return;
    }
    RefineKernel kernel{{}, 0, layout_.inputs, windowWeights(options().subpixel.kRadiusPx)};
    SigmaLimitKernel limit{
        {}, {}, static_cast<float>(options().subpixel.kMaxSigmaPx), layout_.sigma_limits};
    GoodSquaresKernel good{{}, layout_.sigma_limits};
    ConsistentKernel consistent{{},
                                layout_.sigma_limits,
                                static_cast<float>(options().subpixel.kMaxLoneSigmaPx),
                                consistencyRules(options().consistency)};
    for (const MatchScale& level : layout_.levels) {
      const int k = kernel.level_count++, count = static_cast<int>(level.slotCount());
      kernel.levels[k] = {readOnly(level.smooth[0]),
                          readOnly(level.smooth[1]),
                          readOnly(level.smooth[2]),
                          readOnly(level.ignore[0]),
                          readOnly(level.ignore[1]),
                          level.rough,
                          level.refined,
                          count};
      limit.matches[k] = level.refined;
      limit.counts[k] = count;
      good.levels[k] = consistent.levels[k] = {level.refined, level.kept, level.slot_columns,
                                               level.slot_rows, squaresOf(level)};
    }
    executor_.launch("sub-pixel", kernel, kernel.blocks());
    executor_.mark("sub-pixel");
    executor_.launch("sigma limits", limit, Grid{kernel.level_count, 1, 1});
    executor_.launch("good squares", good, good.blocks(kernel.level_count));
    executor_.launch("consistent", consistent, consistent.blocks(kernel.level_count));
    executor_.mark("consistent");
  }

  TakenSquares squaresOf(const MatchScale& level) const {
    return {level.taken, level.taken_columns, options().kCoarseSpacingPx};
  }

  void takeCoarser(std::size_t k) {
    const MatchScale& level = layout_.levels[k];
    const TakenSquares squares = squaresOf(level);
    perSlot("taken squares", TakeSquaresBody{level.kept, squares}, level.slotCount());
    SlotMatch* coarser = level.kept + level.slotCount();
    perSlot("from coarser", FromCoarserBody{coarser, squares},
            layout_.slot_count - static_cast<std::size_t>(coarser - layout_.kept));
    executor_.mark("coarser");
  }

  void predict(const MatchScale& level, const MatchScale& finer) {
    const ConsistentKernel consistent{
        {{level.rough, level.consistent, level.slot_columns, level.slot_rows, {}}},
        nullptr,
        0,
        consistencyRules(options().consistency)};
    executor_.launch("consistent", consistent, consistent.blocks(1));
    perElement("shift sums",
               SumShiftsBody{level.consistent, level.slot_columns, level.slot_rows,
                             layout_.surf.first_px, finer.shifts, finer.shift_square_px},
               finer.shifts.columns[0], finer.shifts.rows[0]);
    executor_.launch("shifts", FillShiftsKernel{finer.shifts}, Grid{});
    executor_.mark("predict");
  }

  void list() {
    perSlot("places", MarkPlacesBody{layout_.kept, layout_.places}, layout_.slot_count);
    executor_.launch("row starts", RowStartsKernel{layout_.places, layout_.match_count}, Grid{});
    perSlot("list", ListMatchesBody{layout_.kept, layout_.places, layout_.list},
            layout_.slot_count);
    executor_.mark("list");
  }

  Executor& executor_;
  const MatchLayout& layout_;
};

}  // namespace softscope::cuda
