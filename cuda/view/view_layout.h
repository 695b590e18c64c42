// cuda/view/view_layout.h: arrays of the model view, planned from image size and number of
// points.
#pragma once

#include <cstddef>

#include "core/error.h"
#include "cuda/device/arena.h"
#include "cuda/view/view_discs.h"
#include "cuda/view/view_draw.h"
#include "features/view_projector.h"

namespace softscope::cuda {

struct ViewLayout {
  ViewLayout(Arena& arena, int width, int height, int point_capacity) : capacity(point_capacity) {
    const auto points = static_cast<std::size_t>(capacity);
    positions_mm = arena.array<ViewVector>(points);
    normals = arena.array<ViewVector>(points);
    colours = arena.array<Rgb8>(points);
    anchors = arena.array<std::uint8_t>(points);
    discs = arena.array<SplatDisc>(points);
    camera = arena.array<ViewProjector>(1);
    point_count = arena.array<int>(1);
    tiles.width = width;
    tiles.height = height;
    tiles.columns = blocksFor(width, DiscTiles::kSide);
    tiles.rows = blocksFor(height, DiscTiles::kSide);
    const auto tile_count = static_cast<std::size_t>(tiles.count());
    tiles.counts = arena.array<int>(2 * tile_count);
    tiles.cursors = tiles.counts == nullptr ? nullptr : tiles.counts + tile_count;
    tiles.starts = arena.array<int>(tile_count + 1);
    tiles.entries = arena.array<int>(points * DiscTiles::kMostOfDisc);
    tiles.sorted = arena.array<int>(points * DiscTiles::kMostOfDisc);
    blended = arena.image<BlendedPixel>(width, height);
    gap_lengths = arena.image<std::uint8_t>(width, height);
    images = {arena.image<Rgb8>(width, height), arena.image<std::uint8_t>(width, height),
              arena.image<float>(width, height), arena.image<std::int32_t>(width, height)};
  }

  int capacity;  // points
  ViewVector *positions_mm, *normals;
  Rgb8* colours;
  std::uint8_t* anchors;
  SplatDisc* discs;
  ViewProjector* camera;
  int* point_count;
  DiscTiles tiles;
  View<BlendedPixel> blended;
  View<std::uint8_t> gap_lengths;
  ViewImages images;
};

/// Throws OptionError for options without GPU version.
inline void requireViewLimits(const ModelViewOptions& options) {
  require(options.gap_px < 255, "gap_px", options.gap_px, "the GPU takes at most 254");
}

}  // namespace softscope::cuda
