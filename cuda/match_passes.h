// cuda/match_passes.h: the order of the kernels of matching, for any executor.
#pragma once

#include <algorithm>

#include "cuda/match_layout.h"
#include "cuda/match_subpixel.h"
#include "cuda/reset_kernel.h"

namespace softscope::cuda {

/// Matching over a layout: from images, masks and anchor to the list of matches.
template <class Executor>
class MatchPasses {
 public:
  MatchPasses(Executor& executor, const MatchLayout& layout)
      : executor_(executor), layout_(layout) {}

  void match() {
    prepareImages();
    describe();
    for (std::size_t k = layout_.levels.size(); k-- > 0;) {
      search(layout_.levels[k]);
      refine(layout_.levels[k]);
      if (k + 1 < layout_.levels.size()) takeCoarser(k);
      if (k > 0) predict(layout_.levels[k], layout_.levels[k - 1]);
    }
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

  void search(const MatchScale& level) {
    const SearchKernel kernel{level.nodes[0],
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

  void keepConsistent(const MatchScale& level, const SlotMatch* from, const float* sigma_limit,
                      SlotMatch* to) {
    perElement("consistent",
               ConsistentBody{from, to, level.slot_columns, level.slot_rows,
                              ConsistentBody::reachOf(options().consistency), sigma_limit,
                              consistencyRules(options().consistency)},
               level.slot_columns, level.slot_rows);
  }

  void refine(const MatchScale& level) {
    if (!isRefined()) {
      perSlot("copy", CopyMatchesBody{level.rough, level.kept}, level.slotCount());
      return;
    }
    const int count = static_cast<int>(level.slotCount());
    const RefineKernel kernel{readOnly(level.smooth[0]),
                              readOnly(level.smooth[1]),
                              readOnly(level.smooth[2]),
                              readOnly(level.ignore[0]),
                              readOnly(level.ignore[1]),
                              layout_.inputs,
                              level.rough,
                              level.refined,
                              count,
                              windowWeights(options().subpixel.kRadiusPx)};
    executor_.launch("sub-pixel", kernel, kernel.blocks());
    executor_.mark("sub-pixel");
    const SigmaLimitKernel limit{level.refined, count,
                                 static_cast<float>(options().subpixel.kMaxSigmaPx),
                                 layout_.sigma_limit};
    executor_.launch("sigma limit", limit, Grid{});
    keepConsistent(level, level.refined, layout_.sigma_limit, level.kept);
    executor_.mark("consistent");
  }

  void takeCoarser(std::size_t k) {
    const MatchScale& level = layout_.levels[k];
    const TakenSquares squares{level.taken, level.taken_columns, options().kCoarseSpacingPx};
    perSlot("taken squares", TakeSquaresBody{level.kept, squares}, level.slotCount());
    SlotMatch* coarser = level.kept + level.slotCount();
    perSlot("from coarser", FromCoarserBody{coarser, squares},
            layout_.slot_count - static_cast<std::size_t>(coarser - layout_.kept));
    executor_.mark("coarser");
  }

  void predict(const MatchScale& level, const MatchScale& finer) {
    keepConsistent(level, level.rough, nullptr, level.consistent);
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
