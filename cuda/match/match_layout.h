// cuda/match/match_layout.h: arrays of matching, planned from settings and image size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/error.h"
#include "cuda/device/arena.h"
#include "cuda/match/match_images.h"
#include "cuda/match/match_list.h"
#include "cuda/match/match_search.h"
#include "cuda/match/match_select.h"
#include "cuda/match/match_surf.h"
#include "features/match_pyramid.h"

namespace softscope::cuda {

/// One resolution of the images.
struct MatchScale {
  MatchScale(Arena& arena, const MatcherOptions& options, int width_px, int height_px,
             double radius_px)
      : width(width_px), height(height_px) {
    const DenseSurfOptions& surf = options.dense_surf;
    for (int image = 0; image < kMatchImages; ++image) {
      gray[image] = arena.image<std::uint8_t>(width, height);
      smooth[image] = arena.image<float>(width, height);
    }
    const int columns = surfNodes(width, surf), rows = surfNodes(height, surf);
    for (int image = 0; image < 2; ++image) {
      ignore[image] = arena.image<std::uint8_t>(width, height);
      squares[image].columns = width / surf.kGridPx;
      squares[image].rows = height / surf.kGridPx;
      squares[image].sums = arena.array<SurfSquare>(count(squares[image]));
      squares[image].valid = arena.array<std::int32_t>(count(squares[image]));
      nodes[image].columns = rows == 0 ? 0 : columns;
      nodes[image].rows = columns == 0 ? 0 : rows;
      nodes[image].descriptors = arena.array<Descriptor>(count(nodes[image]));
      nodes[image].valid = arena.array<std::uint8_t>(count(nodes[image]));
    }
    reach = searchReach(options, surf.kGridPx, radius_px);
    slot_columns = SearchKernel<32>::slotsAlong(nodes[0].columns);
    slot_rows = SearchKernel<32>::slotsAlong(nodes[0].rows);
    rough = arena.array<SlotMatch>(slotCount());
    refined = arena.array<SlotMatch>(slotCount());
    consistent = arena.array<SlotMatch>(slotCount());
    taken_columns = blocksFor(width, options.kCoarseSpacingPx);
    taken_rows = blocksFor(height, options.kCoarseSpacingPx);
  }

  template <class Table>
  static std::size_t count(const Table& table) {
    return static_cast<std::size_t>(table.columns) * static_cast<std::size_t>(table.rows);
  }
  std::size_t slotCount() const {
    return static_cast<std::size_t>(slot_columns) * static_cast<std::size_t>(slot_rows);
  }
  std::size_t placesPerNode() const {
    return SearchKernel<32>::placesPerNode(reach.search, nodes[0].columns, nodes[0].rows);
  }
  std::size_t takenWords() const {
    return (static_cast<std::size_t>(taken_columns) * static_cast<std::size_t>(taken_rows) + 3) / 4;
  }
  ShiftSquares predicted() const {
    if (shifts.count == 0) return {};
    return {shifts.means[0], shifts.columns[0], shifts.rows[0], shift_square_px};
  }

  /// Shifts of this level, filled by the next coarser level.
  void planShifts(Arena& arena, int square_px) {
    shift_square_px = square_px;
    int columns = blocksFor(width, square_px), rows = blocksFor(height, square_px);
    for (bool more = true; more; columns = (columns + 1) / 2, rows = (rows + 1) / 2) {
      const auto squares_count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
      const int k = shifts.count++;
      shifts.columns[k] = columns;
      shifts.rows[k] = rows;
      shifts.sums[k] = arena.array<ShiftSum>(squares_count);
      shifts.means[k] = arena.array<float>(2 * squares_count);
      more = columns > 1 || rows > 1;
    }
  }

  int width, height;
  View<std::uint8_t> gray[kMatchImages], ignore[2];
  View<float> smooth[kMatchImages];
  SurfSquares squares[2];
  SurfNodes nodes[2];  // of the model, of the live image
  SearchReach reach;
  int slot_columns, slot_rows;
  SlotMatch *rough, *refined, *consistent;
  SlotMatch* kept = nullptr;  // followed by those of the coarser levels
  int taken_columns, taken_rows;
  std::uint8_t* taken = nullptr;
  ShiftPyramid shifts{};
  int shift_square_px = 1;
};

struct MatchLayout {
  MatchLayout(Arena& arena, const MatcherOptions& matcher_options, int width, int height)
      : options(matcher_options), surf(surfRules(options.dense_surf)) {
    std::vector<int> widths{width}, heights{height};
    while (std::min(widths.back(), heights.back()) / 2 >= kLeastMatchSidePx) {
      widths.push_back(widths.back() / 2);
      heights.push_back(heights.back() / 2);
    }
    for (std::size_t k = 0; k < widths.size(); ++k)
      levels.emplace_back(arena, options, widths[k], heights[k],
                          k + 1 < widths.size() ? options.kSearchRadiusPx
                                                : options.reach * std::max(widths[k], heights[k]));
    std::size_t distance_count = 0;
    for (MatchScale& level : levels) {
      slot_count += level.slotCount();
      taken_words += level.takenWords();
      distance_count =
          std::max(distance_count, MatchScale::count(level.nodes[0]) * level.placesPerNode());
      if (&level != &levels.back()) level.planShifts(arena, kPredictionSquarePx);
    }
    distances = arena.array<std::uint16_t>(distance_count);
    planSlots(arena);
    for (int image = 0; image < 2; ++image) {
      mask[image] = arena.image<std::uint8_t>(width, height);
      dark_in_row[image] = arena.image<std::uint8_t>(width, height);
    }
    inputs = arena.array<MatchInputs>(1);
    sigma_limits = arena.array<float>(kMostMatchLevels);
    match_count = arena.array<int>(1);
    list = arena.array<SlotMatch>(slot_count);
  }

  MatcherOptions options;
  SurfRules surf;
  std::vector<MatchScale> levels;
  std::size_t slot_count = 0;  // of all levels
  std::uint16_t* distances;
  SlotMatch* kept;
  std::uint32_t* zeroed;  // squares taken, bits and counts of places
  std::size_t taken_words = 0;
  PlaceBits places{};
  View<std::uint8_t> mask[2], dark_in_row[2];
  MatchInputs* inputs;
  float* sigma_limits;  // per level
  int* match_count;
  SlotMatch* list;

  std::size_t zeroedWords() const {
    return taken_words + static_cast<std::size_t>(places.rows) * (places.columns + 1);
  }

 private:
  void planSlots(Arena& arena) {
    kept = arena.array<SlotMatch>(slot_count);
    places.columns = blocksFor(2 * levels.front().width, 32);
    places.rows = 2 * levels.front().height;
    zeroed = arena.array<std::uint32_t>(zeroedWords());
    places.starts = arena.array<int>(static_cast<std::size_t>(places.rows));
    if (kept == nullptr) return;
    SlotMatch* next = kept;
    std::uint32_t* words = zeroed;
    for (MatchScale& level : levels) {
      level.kept = next;
      next += level.slotCount();
      level.taken = reinterpret_cast<std::uint8_t*>(words);
      words += level.takenWords();
    }
    places.words = words;
    places.counts = reinterpret_cast<int*>(words + places.rows * places.columns);
  }
};

/// The first `count` entries of a list.
inline std::vector<PixelMatch> pixelMatches(const SlotMatch* list, int count) {
  std::vector<PixelMatch> matches;
  matches.reserve(static_cast<std::size_t>(count));
  for (const SlotMatch* slot = list; slot != list + count; ++slot)
    matches.push_back({{slot->model_u, slot->model_v},
                       {slot->live_u, slot->live_v},
                       slot->sigma_px,
                       slot->similarity});
  return matches;
}

/// Throws InputError for an image of another size.
template <class T>
void requireMatchShape(const Raster<T>& image, const View<T>& prepared) {
  if (image.width_px != prepared.width || image.height_px != prepared.height)
    throw InputError("the image has " + std::to_string(image.width_px) + " x " +
                     std::to_string(image.height_px) +
                     " pixels, but matching on the GPU was prepared for " +
                     std::to_string(prepared.width) + " x " + std::to_string(prepared.height));
}

/// Throws OptionError for options without GPU version.
inline void requireMatchLimits(const MatcherOptions& options, int width_px, int height_px) {
  require(options.method == MatcherOptions::kDenseSurf, "matcher.method", options.method,
          "only dense-surf runs on the GPU");
  require(options.dense_surf.cell_px == DescribeKernel::kReach * DenseSurfOptions::kGridPx,
          "dense_surf.cell_px", options.dense_surf.cell_px, "the GPU takes 6");
  Arena counting;
  const MatchLayout layout(counting, options, width_px, height_px);
  require(layout.levels.size() <= kMostMatchLevels, "image size", std::min(width_px, height_px),
          "the GPU matches at most ten levels");
  require(layout.levels.back().placesPerNode() <= 65536, "matcher.reach", options.reach,
          "the GPU searches at most 65536 places; take a smaller one");
}

}  // namespace softscope::cuda
