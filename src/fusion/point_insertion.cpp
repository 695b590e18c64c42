#include "fusion/point_insertion.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "fusion/cell_table.h"
#include "fusion/insertion_formulas.h"
#include "fusion/nearest_surface.h"

namespace softscope {
namespace {

/// The nearest depth of the model per pixel.
NearestSurface drawModel(const PointModel& model, const Visibility& visibility,
                         const PosedCamera& camera) {
  NearestSurface drawn(camera.width_px, camera.height_px, 1);
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int pixel = visibility.points[i].pixel;
      if (pixel < 0 || !(model.weights[i] > 0)) continue;
      const float depth_mm = camera.toLeft(model.positions_mm[i]).z();
      drawn.add(pixel % camera.width_px, pixel / camera.width_px, depth_mm);
    }
  });
  return drawn;
}

/// The depths of the model in and around some rows of the image.
class DepthsAround {
 public:
  DepthsAround(const NearestSurface& drawn, const PosedCamera& camera, int begin, int end)
      : width_(camera.width_px),
        top_(std::max(0, begin - kMostFootprintPx)),
        depths_mm_(width_, std::min(camera.height_px, end + kMostFootprintPx) - top_) {
    for (int v = 0; v < depths_mm_.height_px; ++v)
      for (int u = 0; u < width_; ++u) depths_mm_.at(u, v) = drawn.depthAt(u, v + top_);
  }

  float at(int u, int v) const { return depths_mm_.at(u, v - top_); }

  /// least_mm[u]: within `reach` of pixel (u, v).
  void leastWithin(int v, int reach, std::vector<float>* least_mm) const {
    std::vector<float> column(static_cast<std::size_t>(width_ + 2 * reach), kFar);
    const int last = std::min(depths_mm_.height_px - 1, v - top_ + reach);
    for (int y = std::max(0, v - top_ - reach); y <= last; ++y)
      takeMinimum(depths_mm_.row(y), column.data() + reach);
    least_mm->assign(static_cast<std::size_t>(width_), kFar);
    for (int k = 0; k <= 2 * reach; ++k) takeMinimum(column.data() + k, least_mm->data());
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  void takeMinimum(const float* from, float* to) const {
    for (int u = 0; u < width_; ++u) to[u] = from[u] < to[u] ? from[u] : to[u];
  }

  int width_, top_;
  Raster<float> depths_mm_;
};

/// Depths reliable enough to insert points, and unexplained: all model
/// points within reach are behind their band: (F14). Otherwise NaN.
class UnexplainedDepths {
 public:
  UnexplainedDepths(const Observation& observation, const Raster<PixelState>& states,
                    const NearestSurface& drawn, const PosedCamera& camera,
                    const InsertionLimits& limits)
      : depth_(observation.depth),
        states_(states),
        drawn_(drawn),
        camera_(camera),
        limits_(limits) {}

  Raster<float> find() const {
    Raster<float> unexplained(states_.width_px, states_.height_px, kNotMeasured<float>);
    parallelRanges(states_.height_px, 16, [&](int begin, int end) {
      const DepthsAround around(drawn_, camera_, begin, end);
      for (int v = begin; v < end; ++v) findRow(around, v, unexplained.row(v));
    });
    return unexplained;
  }

 private:
  void findRow(const DepthsAround& around, int v, float* unexplained) const {
    std::vector<int> reaches(static_cast<std::size_t>(states_.width_px), 0);
    std::array<bool, kMostFootprintPx + 1> is_asked{};
    const float* sigma_mm = depth_.sigma_mm.empty() ? nullptr : depth_.sigma_mm.row(v);
    for (int u = 0; u < states_.width_px; ++u) {
      const float depth_mm = depth_.depth_mm.at(u, v);
      if (!mayMakePoint(states_.at(u, v), depth_mm, sigma_mm, u, limits_)) continue;
      if (isExplained(around.at(u, v), depth_mm, limits_.band_mm)) continue;
      const int reach = footprintPx(depth_mm, camera_.fx_px, limits_.spacing_mm);
      reaches[static_cast<std::size_t>(u)] = reach;
      is_asked[static_cast<std::size_t>(reach)] = true;
    }
    std::vector<float> least_mm;
    for (int reach = 1; reach <= kMostFootprintPx; ++reach) {
      if (!is_asked[static_cast<std::size_t>(reach)]) continue;
      around.leastWithin(v, reach, &least_mm);
      for (int u = 0; u < states_.width_px; ++u) {
        const float depth_mm = depth_.depth_mm.at(u, v);
        if (reaches[static_cast<std::size_t>(u)] == reach &&
            !isExplained(least_mm[static_cast<std::size_t>(u)], depth_mm, limits_.band_mm))
          unexplained[u] = depth_mm;
      }
    }
  }

  const DepthMap& depth_;
  const Raster<PixelState>& states_;
  const NearestSurface& drawn_;
  const PosedCamera& camera_;
  const InsertionLimits limits_;
};

/// Allowed pixels in the order of the image.
std::vector<std::int32_t> candidatePixels(const Raster<float>& unexplained_mm,
                                          const std::vector<std::uint8_t>& allowed) {
  const int width = unexplained_mm.width_px;
  std::vector<std::vector<std::int32_t>> rows(static_cast<std::size_t>(unexplained_mm.height_px));
  parallelRows(unexplained_mm.height_px, [&](int v) {
    for (std::int32_t i = v * width; i < (v + 1) * width; ++i)
      if (allowed[static_cast<std::size_t>(i)] != 0) rows[static_cast<std::size_t>(v)].push_back(i);
  });
  std::vector<std::int32_t> candidates;
  for (const std::vector<std::int32_t>& row : rows)
    candidates.insert(candidates.end(), row.begin(), row.end());
  return candidates;
}

int countAboveZero(const Raster<float>& depth_mm) {
  std::atomic<int> count{0};
  parallelRows(depth_mm.height_px, [&](int v) {
    const float* row = depth_mm.row(v);
    count += static_cast<int>(
        std::count_if(row, row + depth_mm.width_px, [](float depth) { return depth > 0; }));
  });
  return count;
}

/// Pixels that are converted to points, in the order of the image: (F16), the first of every cell.
std::vector<std::int32_t> choosePixels(const Raster<float>& unexplained_mm,
                                       const PosedCamera& camera,
                                       const std::vector<std::uint8_t>& allowed,
                                       const InsertionLimits& limits) {
  const std::vector<std::int32_t> candidates = candidatePixels(unexplained_mm, allowed);
  std::vector<CellKey> keys(candidates.size());
  parallelRanges(static_cast<int>(candidates.size()), kPointsPerTask, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::int32_t i = candidates[k];
      const Eigen::Vector3f ray =
          camera.ray(i % unexplained_mm.width_px, i / unexplained_mm.width_px);
      keys[k] = insertionCell(ray, unexplained_mm.values[i], camera.fx_px, limits);
    }
  });
  std::vector<std::int32_t> chosen;
  CellHashTable table(candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (keys[k] == kNoCell) continue;
    std::int32_t& held = table.find(keys[k], [&](std::int32_t j) { return keys[j] == keys[k]; });
    if (held != CellHashTable::kEmpty) continue;
    held = static_cast<std::int32_t>(k);
    chosen.push_back(candidates[k]);
  }
  return chosen;
}

/// Grows the capacity by a quarter at a time: doubling would waste memory on a large model.
void makeRoom(std::size_t more, PointModel* model) {
  const std::size_t needed = model->size() + more;
  if (needed > model->positions_mm.capacity())
    model->reserve(std::max(needed, model->size() + model->size() / 4));
}

/// Unexplained pixels that may be converted to points now.
std::vector<std::uint8_t> allowedPixels(const Raster<float>& unexplained_mm,
                                        const PosedCamera& camera, const InsertionMemory& last,
                                        bool at_once, float band_mm) {
  const LastUnexplained unexplained_last{
      last.unexplained_mm.values.data(), last.unexplained_mm.width_px,
      last.unexplained_mm.height_px, posedCamera(last.left, last.world_from_left)};
  std::vector<std::uint8_t> allowed(unexplained_mm.size(), 0);
  parallelRows(unexplained_mm.height_px, [&](int v) {
    for (int u = 0; u < unexplained_mm.width_px; ++u) {
      const float depth_mm = unexplained_mm.at(u, v);
      if (!(depth_mm > 0)) continue;
      allowed[static_cast<std::size_t>(v) * unexplained_mm.width_px + u] =
          at_once ||
          isConfirmed(camera.toWorld(camera.ray(u, v) * depth_mm), unexplained_last, band_mm);
    }
  });
  return allowed;
}

}  // namespace

InsertionSummary insertPoints(const Observation& observation, const Raster<PixelState>& states,
                              const Visibility& visibility, const ColourGain& gain,
                              const FusionOptions& options, InsertionMemory* memory,
                              PointModel* model) {
  options.validate();
  observation.validate();
  requireStates(states, observation);
  requireVisibility(visibility, *model);
  const FusingFrame frame = fusingFrame(observation, gain, options.points, options.colour);
  const PosedCamera& camera = frame.camera;
  const InsertionLimits limits = insertionLimits(options.insertion);
  const NearestSurface drawn = drawModel(*model, visibility, camera);
  Raster<float> unexplained_mm =
      UnexplainedDepths(observation, states, drawn, camera, limits).find();
  const bool at_once = !options.insertion.confirm || model->empty();
  const std::vector<std::uint8_t> allowed =
      allowedPixels(unexplained_mm, camera, *memory, at_once, limits.band_mm);
  const std::vector<std::int32_t> chosen = choosePixels(unexplained_mm, camera, allowed, limits);
  makeRoom(chosen.size(), model);
  for (const std::int32_t pixel : chosen) {
    const ModelPoint point = newPoint(pixel, frame);
    model->add(point.position_mm, point.normal, point.colour, point.weight);
  }
  InsertionSummary summary;
  summary.inserted = static_cast<int>(chosen.size());
  summary.unexplained_px = countAboveZero(unexplained_mm);
  *memory = {std::move(unexplained_mm), observation.left, observation.world_from_left};
  return summary;
}

}  // namespace softscope
