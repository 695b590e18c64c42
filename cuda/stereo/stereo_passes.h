// cuda/stereo/stereo_passes.h: order of the kernels of the stereo stage, for any executor.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/rectified_rig.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/stereo/stereo_layout.h"
#include "stereo/refinement/pyramid.h"

namespace softscope::cuda {

/// The stereo stage over a layout.
template <class Executor>
class StereoPasses {
 public:
  StereoPasses(Executor& executor, const StereoLayout& layout)
      : executor_(executor), layout_(layout) {}

  /// Once after allocation: data that frames do not write.
  void initialise() {
    for (const StereoLevel& level : layout_.levels) {
      executor_.launch("selection",
                       StoreSelectionKernel{selectionOf(level.options.refinement), level.selection},
                       Grid{});
      for (std::uint8_t* bytes : level.gradient_bytes) {
        const FillKernel<std::uint8_t> fill{bytes, level.gradient_byte_count,
                                            GradientPlane::kFlatByte};
        executor_.launch("flat margins", fill, fill.blocks());
      }
      for (const View<std::uint8_t>& ignored : level.ignored) {
        const FillKernel<std::uint8_t> fill{ignored.data, ignored.width * ignored.height, 0};
        executor_.launch("nothing ignored", fill, fill.blocks());
      }
    }
  }

  /// One level of the pyramid, up to refined disparities.
  void matchLevel(const StereoLevel& level) {
    prepare(level);
    findSupport(level);
    interpolatePrior(level);
    perElement("tile bits", TileBitsBody{level.grid, level.kept, level.bits}, level.grid.columns,
               level.grid.rows, 2);
    matchDense(level);
    filter(level);
    refine(level);
  }
  /// Unmatched share of the level.
  void measureShare(const StereoLevel& level) {
    OpenShare* share = &level.counters->share;
    const float* disparity = refined(level).data;
    const NearestKernel nearest{disparity, level.width * level.height, share};
    executor_.launch("nearest", nearest, nearest.blocks());
    const OpenShareKernel open{disparity, readOnly(level.gray[0]), readOnly(level.ignored[0]),
                               level.options.darkest_gray, share};
    executor_.launch("open share", open, open.blocks());
    executor_.mark("share");
  }

  void halve(const StereoLevel& whole, const StereoLevel& half) {
    perPixel(
        "halve",
        HalveBody{{readOnly(whole.gray[0]), readOnly(whole.gray[1])}, {half.gray[0], half.gray[1]}},
        half, 2);
    perPixel("halve ignored",
             HalveIgnoredBody{{readOnly(whole.ignored[0]), readOnly(whole.ignored[1])},
                              {half.ignored[0], half.ignored[1]}},
             half, 2);
  }
  void fillFromHalf(const StereoLevel& half, const StereoLevel& whole) {
    perPixel("fill from half",
             FillFromHalfBody{readOnly(refined(half)), readOnly(half.sigma), refined(whole),
                              whole.sigma},
             whole);
    executor_.mark("fill");
  }

  /// Depth and normals from the full size; can be repeated, the levels are unchanged.
  void finish(const RectifiedRig& rig) {
    const StereoLevel& level = layout_.levels.front();
    const StereoOptions& options = level.options;
    perPixel("dark",
             DropDarkBody{readOnly(refined(level)), readOnly(level.sigma),
                          readOnly(level.dark_rows), readOnly(level.ignored[0]), layout_.smoothed,
                          layout_.smoothed_sigma, options.dark_margin_px},
             level);
    if (options.smoothing.reach_blocks > 0) smooth(level);
    executor_.mark("smooth");
    const View<const float> smoothed = readOnly(layout_.smoothed);
    perPixel("fringes", DoubtFringesBody{readOnly(level.gray[0]), smoothed, layout_.smoothed_sigma},
             level);
    perPixel("rims", FindRimsBody{smoothed, layout_.rims}, level);
    perPixel("rims in rows", LeastRimInRowBody{readOnly(layout_.rims), layout_.rim_rows}, level);
    perPixel("depth",
             DepthBody{smoothed, readOnly(layout_.smoothed_sigma), readOnly(layout_.rim_rows),
                       readOnly(layout_.mask), layout_.inputs, layout_.disparity, layout_.sigma,
                       layout_.depth, layout_.depth_sigma, options.erode_edges_px,
                       options.border_px, static_cast<float>(options.edge_step_px),
                       rig.left.fx_px * rig.baseline_mm, rig.disparity_offset_px},
             level);
    executor_.mark("depth");
    const auto fx_px = static_cast<float>(rig.left.fx_px),
               fy_px = static_cast<float>(rig.left.fy_px),
               cx_px = static_cast<float>(rig.left.cx_px);
    const NormalKernel normals{readOnly(layout_.depth), layout_.normals, fx_px, fy_px, cx_px,
                               rig.left.cy_px};
    executor_.launch("normals", normals, normals.blocks());
    executor_.mark("normals");
  }

  /// After finish().
  void drop() {
    perPixel("drop",
             DropPixelBody{readOnly(layout_.dropped),
                           {layout_.disparity, layout_.sigma, layout_.depth, layout_.depth_sigma},
                           layout_.normals},
             layout_.levels.front());
  }

  static View<float> refined(const StereoLevel& level) {
    return disparityOf(level, RefinementOptions::steps);
  }

 private:
  template <class Body>
  void perPixel(const char* name, const Body& body, const StereoLevel& level, int depth = 1) {
    perElement(name, body, level.width, level.height, depth);
  }
  template <class Body>
  void perElement(const char* name, const Body& body, int width, int height, int depth = 1) {
    const PixelKernel<Body> kernel{body, width, height};
    executor_.launch(name, kernel, kernel.grid(depth));
  }

  void prepare(const StereoLevel& level) {
    const auto words = [](std::size_t bytes) { return (bytes + 3) / 4; };
    const auto pixels = static_cast<std::size_t>(level.width) * level.height;
    const auto points = static_cast<std::size_t>(level.grid.columns) * level.grid.rows;
    ResetKernel reset{};
    reset.add(level.costs.best_left,
              2 * static_cast<std::size_t>(level.grid.rows) * level.grid.width, kNoCost);
    reset.add(level.support, points, floatAsBits(kNoSupport));
    reset.add(level.bits.words, level.bitWords(), 0);
    reset.add(level.marks.data, words(pixels), 0);
    reset.add(level.counters, words(sizeof(LevelCounters)), 0);
    executor_.launch("reset", reset, reset.blocks());
    perPixel("ignored rows",
             IgnoredRowBody{{readOnly(level.ignored[0]), readOnly(level.ignored[1])},
                            {level.ignored_rows[0], level.ignored_rows[1]}},
             level, 2);
    perPixel("ignored columns",
             IgnoredColumnBody{{readOnly(level.ignored_rows[0]), readOnly(level.ignored_rows[1])},
                               {level.ignored[0], level.ignored[1]}},
             level, 2);
    perPixel("gradient",
             GradientBody{{readOnly(level.gray[0]), readOnly(level.gray[1])},
                          {level.gradient[0], level.gradient[1]},
                          gainQ8(level.options.elas.gradient_gain)},
             level, 2);
    executor_.mark("gradients");
  }

  void findSupport(const StereoLevel& level) {
    LevelCounters* counters = level.counters;
    matchRows(level, SupportPass{});
    const NarrowRangeKernel narrow{level.grid, level.support, &counters->narrowed};
    executor_.launch("narrow range", narrow, Grid{});
    matchRows(level, SupportPass{&counters->narrowed});
    const LonelyKernel lonely{level.grid, level.support, level.kept, &counters->point_count};
    executor_.launch("lonely", lonely, lonely.blocks());
    executor_.mark("support");
  }
  void matchRows(const StereoLevel& level, const SupportPass& pass) {
    const SupportCostKernel costs{level.grid, pass, level.gradient[0], level.gradient[1],
                                  level.costs};
    executor_.launch("support costs", costs, costs.blocks());
    const SupportTestKernel test{
        level.grid,        pass,
        level.gradient[0], {readOnly(level.ignored[0]), readOnly(level.ignored[1])},
        level.costs,       level.support};
    executor_.launch("support tests", test, test.blocks());
  }

  void interpolatePrior(const StereoLevel& level) {
    const PriorRowKernel rows{level.grid, level.kept, level.rows};
    executor_.launch("prior rows", rows, rows.blocks());
    const PriorSweepKernel sweep{level.rows};
    executor_.launch("prior sweep", sweep, sweep.blocks());
    perPixel("prior", PriorBody{level.rows, {level.prior[0], level.prior[1]}}, level, 2);
    executor_.mark("prior");
  }

  void matchDense(const StereoLevel& level) {
    const DenseKernel dense{{level.gradient[0], level.gradient[1]},
                            {readOnly(level.prior[0]), readOnly(level.prior[1])},
                            {readOnly(level.ignored[0]), readOnly(level.ignored[1])},
                            {level.whole[0], level.whole[1]},
                            level.bits,
                            &level.counters->point_count,
                            priorCostOf(level.options.elas),
                            level.grid.range};
    executor_.launch("dense", dense, dense.blocks());
    executor_.mark("dense");
  }

  void filter(const StereoLevel& level) {
    const StereoOptions& options = level.options;
    const ElasOptions& elas = options.elas;
    perPixel("dark rows",
             DarkRowBody{readOnly(level.gray[0]), level.dark_rows, options.darkest_gray,
                         options.dark_margin_px},
             level);
    perPixel(
        "left-right",
        LeftRightBody{readOnly(level.whole[0]), readOnly(level.whole[1]), readOnly(level.dark_rows),
                      level.disparity[0], elas.left_right_px, options.dark_margin_px},
        level);
    const Islands islands{level.disparity[0], level.islands_labels, level.islands_sizes,
                          static_cast<float>(elas.speckle_step_px), elas.speckle_size_px};
    const TileIslandsKernel tiles{islands};
    executor_.launch("islands of tiles", tiles, tiles.blocks());
    perElement("join tiles", JoinTilesBody{islands}, std::max(level.width, level.height),
               std::max(level.width, level.height) / TileIslandsKernel::kHeight, 2);
    perPixel("sum islands", SumIslandsBody{islands}, level);
    perPixel("drop islands", DropIslandsBody{islands}, level);
    const auto gap_step = static_cast<float>(elas.gap_step_px);
    for (const bool along_rows : {true, false})
      perPixel("gaps",
               FillGapsBody{readOnly(level.disparity[along_rows ? 0 : 1]),
                            level.disparity[along_rows ? 1 : 0], readOnly(level.ignored[0]),
                            elas.gap_width_px, gap_step, along_rows},
               level);
    executor_.mark("filter");
  }

  void refine(const StereoLevel& level) {
    const RefinementOptions& options = level.options.refinement;
    const RefinementWindow window = refinementWindow(options);
    splitBrightness(level);
    const View<const float> initial = readOnly(level.disparity[0]);
    perPixel("depth steps",
             MarkStepsBody{initial, level.marks, 2 * options.radius_px + 1,
                           RefinementWindow::kClearStepPx, RefinementWindow::kSlope},
             level);
    perPixel("near steps",
             SpreadRowBody{readOnly(level.marks), level.near_marks, options.radius_px}, level);
    const MarkMixedKernel mark{initial,
                               readOnly(level.near_marks),
                               level.mixed,
                               level.mixed_list,
                               &level.counters->mixed_count,
                               options.radius_px,
                               selectionOf(options)};
    executor_.launch("mixed windows", mark, mark.blocks());
    for (int i = 0; i + 1 < options.steps; ++i) step<false>(level, i, window);
    step<true>(level, options.steps - 1, window);
    shrinkRelief(level, window);
    if (options.dropsBeyondEvidence()) dropBeyondEvidence(level);
    if (options.dropsUneven()) dropUneven(level);
    executor_.mark("refine");
  }
  static Selection selectionOf(const RefinementOptions& options) {
    const RefinementWindow window = refinementWindow(options);
    Selection selection{};
    std::copy(window.selection.begin(), window.selection.end(), selection.weights);
    std::copy(window.tolerance.begin(), window.tolerance.end(), selection.tolerance);
    return selection;
  }
  void splitBrightness(const StereoLevel& level) {
    const std::vector<float> slow =
        slowBrightnessWeights(level.options.refinement.highpass_sigma_px);
    SlowWeights weights{};
    weights.reach = static_cast<int>(slow.size()) / 2;
    std::copy(slow.begin(), slow.end(), weights.values);
    perPixel("brightness rows",
             BrightnessRowBody{{readOnly(level.gray[0]), readOnly(level.gray[1])},
                               {level.slow[0], level.slow[1]},
                               {level.smooth[0], level.smooth[1]},
                               weights},
             level, 2);
    perPixel("brightness columns",
             BrightnessColumnBody{{readOnly(level.slow[0]), readOnly(level.slow[1])},
                                  {readOnly(level.smooth[0]), readOnly(level.smooth[1])},
                                  {level.fast_part[0], level.fast_part[1]},
                                  {level.slow_part[0], level.slow_part[1]},
                                  weights},
             level, 2);
    executor_.mark("brightness");
  }
  /// Before step i, or after the last.
  static View<float> disparityOf(const StereoLevel& level, int i) {
    return i == RefinementOptions::plane_steps ? level.planes : level.disparity[i % 2];
  }
  template <bool kLast>
  void step(const StereoLevel& level, int i, const RefinementWindow& window) {
    const RefinementOptions& options = level.options.refinement;
    const View<const float> before = readOnly(disparityOf(level, i));
    const RefinementStep rules = refinementStep(i);
    const PlaneLimits limits = planeLimits(options);
    const LightFitKernel light{readOnly(level.slow_part[0]),
                               readOnly(level.slow_part[1]),
                               before,
                               level.light_parts,
                               &level.counters->light,
                               i};
    executor_.launch("light", light, light.blocks());
    perPixel("residuals",
             ResidualBody<kLast>{readOnly(level.fast_part[0]), readOnly(level.fast_part[1]),
                                 readOnly(level.slow_part[0]), readOnly(level.slow_part[1]), before,
                                 &level.counters->light, level.residuals,
                                 residualLimits(options, rules)},
             level);
    // Windows with mixed surfaces, slow to solve, are processed in the second step.
    const bool hold = i == 0 && !kLast;
    StepSolver solver{limits,      rules,          before, disparityOf(level, i + 1),
                      level.sigma, level.response, {},     {}};
    if (options.dropsBeyondEvidence()) {
      solver.beside = level.smooth[0];
      solver.below = level.smooth[1];
    }
    WindowStepKernel<kLast> windows{level.residuals,
                                    readOnly(level.mixed),
                                    solver,
                                    hold ? MixedWindows::kHold : MixedWindows::kLeave,
                                    {}};
    std::copy(window.weights.begin(), window.weights.end(), windows.window);
    executor_.launch("windows", windows, windows.blocks());
    if (hold) return;
    const MixedStepKernel<kLast> mixed{
        level.residuals, level.mixed_list, &level.counters->mixed_count,
        solver,          level.selection,  options.radius_px};
    executor_.launch("mixed windows' step", mixed, mixed.blocks());
  }

  void shrinkRelief(const StereoLevel& level, const RefinementWindow& window) {
    const auto plane = [&](int i) {
      return View<float>{level.residuals.planes[i], level.width, level.height, level.width};
    };
    WindowWeights weights{
        {}, level.options.refinement.radius_px, RefinementWindow::kReliefSpacingPx};
    std::copy(window.weights.begin(), window.weights.end(), weights.values);
    cuda::shrinkRelief(executor_, {readOnly(level.planes), readOnly(level.response), refined(level),
                                   level.sigma, plane(0), plane(1), level.relief_squares[0],
                                   level.relief_squares[1], level.smooth_relief, weights,
                                   planeLimits(level.options.refinement).model_variance_px2});
  }

  void dropBeyondEvidence(const StereoLevel& level) {
    const RefinementOptions& options = level.options.refinement;
    perPixel("beyond evidence",
             MarkBeyondEvidenceBody{readOnly(refined(level)), readOnly(level.smooth[0]),
                                    readOnly(level.smooth[1]), readOnly(level.fast_part[0]),
                                    readOnly(level.slow_part[0]), level.near_marks,
                                    rimFromEvidencePx(options), options.radius_px},
             level);
    dropMarked(level);
  }
  void dropUneven(const StereoLevel& level) {
    perPixel("uneven windows",
             MarkUnevenBody{readOnly(refined(level)), level.near_marks,
                            level.options.refinement.radius_px},
             level);
    dropMarked(level);
  }
  void dropMarked(const StereoLevel& level) {
    perPixel("drop marked", DropMarkedBody{readOnly(level.near_marks), refined(level), level.sigma},
             level);
  }

  void smooth(const StereoLevel& level) {
    const std::vector<float> weights = smoothingWindow(layout_.smoothing.reach);
    const BlockMeanKernel means{readOnly(layout_.smoothed), readOnly(layout_.smoothed_sigma),
                                layout_.smoothing, layout_.means};
    executor_.launch("block means", means, means.blocks());
    FitPatchKernel fit{layout_.smoothing, layout_.means, layout_.patches, {}};
    std::copy(weights.begin(), weights.end(), fit.window.weights);
    executor_.launch("fit patches", fit, fit.blocks());
    perPixel(
        "smooth",
        SmoothBody{layout_.smoothing, layout_.patches, layout_.smoothed, layout_.smoothed_sigma},
        level);
  }

  Executor& executor_;
  const StereoLayout& layout_;
};

}  // namespace softscope::cuda
