// cuda/comparison/comparison_passes.h: the order of the kernels that compare model and frame, for
// any executor.
#pragma once

#include "cuda/comparison/comparison_pixels.h"
#include "cuda/comparison/comparison_points.h"
#include "cuda/device/reset_kernel.h"

namespace softscope::cuda {

template <class Executor>
class ComparisonPasses {
 public:
  explicit ComparisonPasses(Executor& executor) : executor_(executor) {}

  /// Visibility of each point; with `draws`, also the point shown by each pixel.
  void findSight(const ComparisonFrameLayout& frame, const ComparisonModelLayout& model,
                 const PosedCamera& camera, const SightLimits& limits, bool draws) {
    ResetKernel reset;
    reset.add(frame.near_cells, frame.cells(), floatAsBits(kFar));
    if (draws) {
      reset.add(frame.drawn_cells, frame.cells(), floatAsBits(kFar));
      reset.add(frame.drawn, 2 * pixels(frame), 0xFFFFFFFFu);  // DrawnPoints::kNoPoint
      reset.add(frame.totals, frame.totals_bytes / sizeof(std::uint32_t), 0);
      reset.add(frame.rank_counts, kRankCounts, 0);
    }
    launch("reset", reset);
    launch("sight", SightKernel{frame, model, camera, limits, draws});
    launch("hide", HideKernel{frame, model, camera});
    executor_.mark("sight");
  }

  /// After findSight(): gain, anchors and innovation.
  void findVisiblePoints(const ComparisonFrameLayout& frame, const ComparisonModelLayout& model,
                         const ComparisonGraphLayout& graph, const SeenQuestions& asked) {
    if (asked.innovation) {
      ResetKernel reset;
      reset.add(graph.sums, static_cast<std::size_t>(graph.nodes) * sizeof(InnovationSums) / 4, 0);
      launch("reset", reset);
    }
    launch("seen", SeenKernel{frame, model, graph, asked});
    if (asked.innovation) {
      launch("mean difference", MeanDifferenceKernel{graph, frame.totals});
      launch("square difference",
             SquareDifferenceKernel{frame, model, graph, asked.reference_mm, asked.largest_weight});
    }
    executor_.mark("seen");
  }

  /// After findSight() with `draws`: differences of depths, their rank, and evidence where
  /// `compares_images`.
  void comparePixels(const ComparisonFrameLayout& frame, const ComparisonModelLayout& model,
                     const PosedCamera& camera, bool compares_images) {
    launch("evidence",
           EvidenceKernel{frame, model, camera, static_cast<float>(PixelOptions::kEdgeStep),
                          evidenceShiftPx(frame.width), compares_images});
    for (int step = 0; step < kRankSteps; ++step) {
      if (step > 0) {
        const PixelKernel<CountRankBody> count{{frame, step}, frame.width, frame.height};
        executor_.launch("count rank", count, count.grid());
      }
      launch("pick rank",
             PickRankKernel<Percentile95>{frame.rank_counts, &frame.totals->rank, step, 1});
    }
    executor_.mark("pixels");
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  static std::size_t pixels(const ComparisonFrameLayout& frame) {
    return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  }
  template <class Kernel>
  void launch(const char* name, const Kernel& kernel) {
    executor_.launch(name, kernel, kernel.blocks());
  }

  Executor& executor_;
};

}  // namespace softscope::cuda
