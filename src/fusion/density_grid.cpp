#include "fusion/density_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/cell_table.h"
#include "fusion/density_formulas.h"

namespace softscope {
namespace {

constexpr int kMostParts = 8;  // each visits all points

/// Cells of all points; kNoCell for removed ones.
std::vector<CellKey> cellsOf(const PointModel& model, const PosedCamera& camera, float cell_mm) {
  std::vector<CellKey> keys(model.size());
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      keys[i] = isKeptInModel(model.normals[i], model.weights[i])
                    ? densityCell(model.positions_mm[i], camera, cell_mm)
                    : kNoCell;
  });
  return keys;
}

/// docs/fusion.md (F18).
void mergePoints(PointModel* model, std::int32_t survivor, std::int32_t other) {
  const auto shapeOf = [model](std::int32_t i) {
    return ModelPoint{model->positions_mm[i], model->normals[i], {}, 0, model->weights[i]};
  };
  ModelPoint merged = shapeOf(survivor);
  mergeInto(shapeOf(other), &merged);
  model->positions_mm[survivor] = merged.position_mm;
  model->normals[survivor] = merged.normal;
  model->weights[survivor] = merged.weight;
  if (!model->bindings[survivor].bound()) model->bindings[survivor] = model->bindings[other];
}

/// Index of the part that handles a cell.
unsigned partOf(CellKey key, unsigned parts) {
  return static_cast<unsigned>((key * 0x9E3779B97F4A7C15ULL) >> 40) % parts;
}

/// Merges within the cells of one part.
void mergePart(unsigned part, unsigned parts, const std::vector<CellKey>& keys, float cosine,
               PointModel* model, std::vector<std::int32_t>* heirs) {
  std::vector<std::int32_t>& heir = *heirs;
  std::vector<std::int32_t> own;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (keys[k] != kNoCell && partOf(keys[k], parts) == part)
      own.push_back(static_cast<std::int32_t>(k));
  CellHashTable table(own.size());
  for (const std::int32_t i : own) {
    const std::size_t k = static_cast<std::size_t>(i);
    std::int32_t& held = table.find(keys[k], [&](std::int32_t j) {
      return keys[j] == keys[k] && onSameSide(model->normals[j], model->normals[i], cosine);
    });
    if (held == CellHashTable::kEmpty) {
      held = i;
    } else if (model->weights[i] > model->weights[held]) {
      mergePoints(model, i, held);
      heir[held] = i;
      held = i;
    } else {
      mergePoints(model, held, i);
      heir[k] = held;
    }
  }
}

/// Merges within cells. Afterwards heir[i] is i, or the point
/// that i was merged into (or its heir). Cells are independent.
std::vector<std::int32_t> mergeCells(const std::vector<CellKey>& keys, float cosine,
                                     PointModel* model) {
  std::vector<std::int32_t> heir(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k)
    heir[k] = keys[k] == kNoCell ? IndexMap::kRemoved : static_cast<std::int32_t>(k);
  const int parts = std::min(kMostParts, threadCount());
  parallelRanges(parts, 1, [&](int begin, int end) {
    for (int part = begin; part < end; ++part)
      mergePart(static_cast<unsigned>(part), static_cast<unsigned>(parts), keys, cosine, model,
                &heir);
  });
  return heir;
}

template <class T>
void keepAt(std::vector<T>* values, const std::vector<std::int32_t>& old_of_new) {
  for (std::size_t k = 0; k < old_of_new.size(); ++k) (*values)[k] = (*values)[old_of_new[k]];
  values->resize(old_of_new.size());
}

void compact(PointModel* model, const std::vector<std::int32_t>& old_of_new) {
  const auto keepShapes = [&] {
    parallelInvoke([&] { keepAt(&model->positions_mm, old_of_new); },
                   [&] { keepAt(&model->normals, old_of_new); });
  };
  const auto keepRest = [&] {
    keepAt(&model->colours, old_of_new);
    keepAt(&model->anchors, old_of_new);
    keepAt(&model->weights, old_of_new);
  };
  parallelInvoke(keepShapes,
                 [&] { parallelInvoke([&] { keepAt(&model->bindings, old_of_new); }, keepRest); });
}

/// Converts heirs to new indices; lists the remaining points.
IndexMap indexMap(std::vector<std::int32_t> heir, std::vector<std::int32_t>* old_of_new) {
  IndexMap map;
  map.new_of_old.assign(heir.size(), IndexMap::kRemoved);
  for (std::size_t i = 0; i < heir.size(); ++i) {
    if (heir[i] != static_cast<std::int32_t>(i)) continue;
    map.new_of_old[i] = static_cast<std::int32_t>(old_of_new->size());
    old_of_new->push_back(static_cast<std::int32_t>(i));
  }
  map.new_count = static_cast<std::int32_t>(old_of_new->size());
  for (std::size_t i = 0; i < heir.size(); ++i) {
    std::int32_t last = heir[i];
    if (last == IndexMap::kRemoved) continue;
    while (heir[last] != last) last = heir[last];
    map.new_of_old[i] = map.new_of_old[last];
  }
  return map;
}

}  // namespace

IndexMap keepDensity(const DensityOptions& options, const PosedCamera& camera, PointModel* model) {
  require(options.cell_mm >= 0.01, "fusion.point_spacing_mm", options.cell_mm,
          "must be 0.01 or more");
  const std::vector<CellKey> keys = cellsOf(*model, camera, static_cast<float>(options.cell_mm));
  const float cosine = static_cast<float>(std::cos(options.kMaxAngleDeg * M_PI / 180));
  std::vector<std::int32_t> old_of_new;
  IndexMap map = indexMap(mergeCells(keys, cosine, model), &old_of_new);
  if (!map.identity()) compact(model, old_of_new);
  return map;
}

}  // namespace softscope
