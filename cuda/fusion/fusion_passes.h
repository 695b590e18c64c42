// cuda/fusion/fusion_passes.h: the order of the kernels of stage 7, for any executor.
#pragma once

#include <limits>

#include "cuda/device/ordered_list.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/fusion/fusion_density.h"
#include "cuda/fusion/fusion_insertion.h"
#include "cuda/fusion/fusion_points.h"

namespace softscope::cuda {

/// What stage 7 works on; arrays lie on the device.
struct FusionWork {
  FusingFrame frame;
  const PixelState* states = nullptr;
  AnchoredBlocks anchored;
  InsertionLimits insertion;
  LastUnexplained last;
  bool at_once = false;  // new points need no confirmation
  float cell_mm = 0, least_cosine = 0;
  FusionFrameLayout image;
  float* unexplained_mm = nullptr;
  FusionPointLayout points;
  const PointSight* sights = nullptr;
  FusionGraphLayout graph;
  ModelArrays model, updated;
  int count = 0;  // points of the model

  int pixels() const { return frame.camera.width_px * frame.camera.height_px; }
};

template <class Executor>
class FusionPasses {
 public:
  explicit FusionPasses(Executor& executor) : executor_(executor) {}

  void update(const FusionWork& work) {
    fuse(work);
    insert(work);
    keepDensity(work);
  }

 private:
  static constexpr std::uint32_t kFreeKey = 0xFFFFFFFFu;  // both halves of kNoCell
  static_assert(kNoCell == ~CellKey{0});

  void fuse(const FusionWork& work) {
    ResetKernel reset;
    reset.add(work.image.nearest, static_cast<std::size_t>(work.pixels()),
              floatAsBits(std::numeric_limits<float>::infinity()));
    reset.add(work.image.counts, sizeof(FusionCounts) / sizeof(std::uint32_t), 0);
    reset.add(work.points.keys, 2 * work.points.slot_count, kFreeKey);
    reset.add(work.points.values, work.points.slot_count, 0xFFFFFFFFu);
    launch("reset", reset);
    launch("fuse", FuseKernel{work.frame, work.model, work.count, work.sights, work.graph,
                              work.anchored, work.image.nearest, work.image.counts});
    executor_.mark("fuse");
  }
  void insert(const FusionWork& work) {
    const PosedCamera& camera = work.frame.camera;
    const PixelKernel<UnexplainedBody> find{
        {work.frame, work.insertion, work.last, work.at_once, work.states, work.image,
         work.unexplained_mm, cellsOf(work), work.points.values},
        camera.width_px,
        camera.height_px};
    executor_.launch("find unexplained", find, find.grid());
    putInOrder(executor_,
               NewPoints{work.frame, work.image.slots, work.points.values, work.model, work.count,
                         work.pixels()},
               work.points.block_counts, &work.image.counts->inserted);
    executor_.mark("insert");
  }
  void keepDensity(const FusionWork& work) {
    ResetKernel reset;
    reset.add(work.points.keys, 2 * work.points.slot_count, kFreeKey);
    reset.add(work.points.values, work.points.slot_count, 0);
    launch("reset", reset);
    const DensePoints all{work.model, work.count, work.count + work.pixels(), work.image.counts,
                          work.points};
    const auto perPoint = [&](const char* name, const auto& kernel) {
      executor_.launch(name, kernel, all.blocks(kernel.kThreads));
    };
    perPoint("cells", CellsKernel{all, work.frame.camera, work.cell_mm, cellsOf(work)});
    launch("room", CellRoomKernel{work.points, work.image.counts});
    perPoint("list cells", ListCellsKernel{all});
    launch("merge cells", MergeCellsKernel{work.model, work.points, work.least_cosine});
    putInOrder(executor_, StayingPoints{all, work.updated}, work.points.block_counts,
               &work.image.counts->kept);
    perPoint("heirs", HeirsKernel{all});
    executor_.mark("density");
  }

  static CellSlots cellsOf(const FusionWork& work) {
    return {work.points.keys, work.points.slot_count};
  }
  template <class Kernel>
  void launch(const char* name, const Kernel& kernel) {
    executor_.launch(name, kernel, kernel.blocks());
  }

  Executor& executor_;
};

}  // namespace softscope::cuda
