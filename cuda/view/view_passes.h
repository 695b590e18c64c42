// cuda/view/view_passes.h: order of the kernels of the model view, for any executor.
#pragma once

#include "cuda/device/reset_kernel.h"
#include "cuda/view/view_layout.h"

namespace softscope::cuda {

/// Images of the view from points, their count and the camera in a layout.
template <class Executor>
class ViewPasses {
 public:
  ViewPasses(Executor& executor, const ViewLayout& layout) : executor_(executor), layout_(layout) {}

  void draw(const ModelViewOptions& options) {
    const DiscTiles& tiles = layout_.tiles;
    ResetKernel reset{};
    reset.add(tiles.counts, 2 * static_cast<std::size_t>(tiles.count()), 0);
    executor_.launch("reset", reset, reset.blocks());
    const PlaceDiscsKernel place{
        {layout_.positions_mm, layout_.normals, layout_.colours, layout_.anchors},
        layout_.capacity,
        layout_.point_count,
        layout_.camera,
        layout_.discs,
        tiles};
    executor_.launch("discs", place, place.blocks());
    executor_.launch("tile starts", TileStartsKernel{tiles}, Grid{});
    const ListDiscsKernel lists{layout_.discs, layout_.capacity, layout_.point_count, tiles};
    executor_.launch("list discs", lists, lists.blocks());
    const SortDiscsKernel sort{tiles};
    executor_.launch("sort discs", sort, sort.blocks());
    executor_.mark("discs");
    const auto surface_depth_mm = static_cast<float>(options.kSurfaceDepthMm);
    const ViewImages& view = layout_.images;
    const DrawTilesKernel draw{tiles,      layout_.discs, layout_.blended,
                               view.depth, view.point,    surface_depth_mm};
    executor_.launch("draw", draw, draw.blocks());
    perPixel("straighten", StraightenBody{readOnly(layout_.blended), readOnly(view.depth),
                                          view.colour, view.anchor, surface_depth_mm});
    executor_.mark("draw");
    fillGaps(options.gap_px, surface_depth_mm);
  }

 private:
  template <class Body>
  void perPixel(const char* name, const Body& body) {
    const PixelKernel<Body> kernel{body, layout_.tiles.width, layout_.tiles.height};
    executor_.launch(name, kernel, kernel.grid());
  }
  void fillGaps(int gap_px, float step_mm) {
    if (gap_px < 1) return;
    for (const bool along_rows : {true, false}) {
      perPixel("find gaps", FindGapsBody{readOnly(layout_.images.depth), layout_.gap_lengths,
                                         gap_px, step_mm, along_rows});
      perPixel("bridge gaps",
               BridgeGapsBody{readOnly(layout_.gap_lengths), layout_.images, gap_px, along_rows});
    }
    executor_.mark("gaps");
  }

  Executor& executor_;
  const ViewLayout& layout_;
};

}  // namespace softscope::cuda
