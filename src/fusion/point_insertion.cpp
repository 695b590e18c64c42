#include "fusion/point_insertion.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/cell_table.h"
#include "fusion/colour_levels.h"
#include "fusion/fusion_weights.h"
#include "fusion/nearest_surface.h"
#include "fusion/point_spacing.h"

namespace softscope {
namespace {

constexpr int kMostFootprint = 10;  // pixels
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Pixels nearer to a point than this get no new one: (F14).
int footprintPx(float depth_mm, float focal_px, float spacing_mm) {
  const float spacing_px = spacingAt(depth_mm, focal_px, spacing_mm) * focal_px / depth_mm;
  // In double precision, the sum is exact: truncation rounds.
  const int rounded = static_cast<int>(static_cast<double>(std::min(spacing_px, 100.0f)) + 0.5);
  return std::clamp(rounded, 1, kMostFootprint);
}

/// The model's nearest depth in every pixel.
NearestSurface drawModel(const PointModel& model, const Visibility& visibility,
                         const PosedCamera& camera) {
  NearestSurface drawn(camera.width_px, camera.height_px, 1);
  parallelRanges(static_cast<int>(model.size()), kPointsATask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const int pixel = visibility.points[i].pixel;
      if (pixel < 0 || !(model.weights[i] > 0)) continue;
      const float depth_mm = camera.toLeft(model.positions_mm[i]).z();
      drawn.add(pixel % camera.width_px, pixel / camera.width_px, depth_mm);
    }
  });
  return drawn;
}

/// The model's depths in and around some rows of the image.
class DepthsAround {
 public:
  DepthsAround(const NearestSurface& drawn, const PosedCamera& camera, int begin, int end)
      : width_(camera.width_px),
        top_(std::max(0, begin - kMostFootprint)),
        depths_mm_(width_, std::min(camera.height_px, end + kMostFootprint) - top_) {
    for (int v = 0; v < depths_mm_.height_px; ++v)
      for (int u = 0; u < width_; ++u) depths_mm_.at(u, v) = drawn.depthAt(u, v + top_);
  }

  float at(int u, int v) const { return depths_mm_.at(u, v - top_); }

  /// least_mm[u]: within `reach` of pixel (u, v).
  void leastWithin(int v, int reach, std::vector<float>* least_mm) const {
    std::vector<float> column(static_cast<std::size_t>(width_ + 2 * reach), kFar);
    const int last = std::min(depths_mm_.height_px - 1, v - top_ + reach);
    for (int y = std::max(0, v - top_ - reach); y <= last; ++y)
      takeLess(depths_mm_.row(y), column.data() + reach);
    least_mm->assign(static_cast<std::size_t>(width_), kFar);
    for (int k = 0; k <= 2 * reach; ++k) takeLess(column.data() + k, least_mm->data());
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  void takeLess(const float* from, float* to) const {
    for (int u = 0; u < width_; ++u) to[u] = from[u] < to[u] ? from[u] : to[u];
  }

  int width_, top_;
  Raster<float> depths_mm_;
};

/// Depths reliable enough to make points, and unexplained: the model has no point within reach
/// that is not behind their band: (F14). NaN elsewhere.
class UnexplainedDepths {
 public:
  UnexplainedDepths(const Observation& observation, const Raster<PixelState>& states,
                    const NearestSurface& drawn, const PosedCamera& camera,
                    const InsertionOptions& options)
      : depth_(observation.depth),
        states_(states),
        drawn_(drawn),
        camera_(camera),
        max_sigma_mm_(static_cast<float>(options.max_sigma_mm)),
        band_mm_(static_cast<float>(options.band_mm)),
        spacing_mm_(static_cast<float>(options.spacing_mm)) {}

  Raster<float> find() const {
    Raster<float> unexplained(states_.width_px, states_.height_px, kNaN);
    parallelRanges(states_.height_px, 16, [&](int begin, int end) {
      const DepthsAround around(drawn_, camera_, begin, end);
      for (int v = begin; v < end; ++v) findRow(around, v, unexplained.row(v));
    });
    return unexplained;
  }

 private:
  void findRow(const DepthsAround& around, int v, float* unexplained) const {
    std::vector<int> reaches(static_cast<std::size_t>(states_.width_px), 0);
    std::array<bool, kMostFootprint + 1> is_asked{};
    for (int u = 0; u < states_.width_px; ++u) {
      if (!isSure(u, v)) continue;
      const float depth_mm = depth_.depth_mm.at(u, v);
      if (around.at(u, v) < depth_mm + band_mm_) continue;
      const int reach = footprintPx(depth_mm, camera_.fx_px, spacing_mm_);
      reaches[static_cast<std::size_t>(u)] = reach;
      is_asked[static_cast<std::size_t>(reach)] = true;
    }
    std::vector<float> least_mm;
    for (int reach = 1; reach <= kMostFootprint; ++reach) {
      if (!is_asked[static_cast<std::size_t>(reach)]) continue;
      around.leastWithin(v, reach, &least_mm);
      for (int u = 0; u < states_.width_px; ++u) {
        const float depth_mm = depth_.depth_mm.at(u, v);
        if (reaches[static_cast<std::size_t>(u)] == reach &&
            !(least_mm[static_cast<std::size_t>(u)] < depth_mm + band_mm_))
          unexplained[u] = depth_mm;
      }
    }
  }

  bool isSure(int u, int v) const {
    return states_.at(u, v) == PixelState::kSure &&
           (depth_.sigma_mm.empty() || depth_.sigma_mm.at(u, v) <= max_sigma_mm_);
  }

  const DepthMap& depth_;
  const Raster<PixelState>& states_;
  const NearestSurface& drawn_;
  const PosedCamera& camera_;
  const float max_sigma_mm_, band_mm_, spacing_mm_;
};

/// Whether the last frame saw something unexplained there as well: (F15).
bool confirmed(const Eigen::Vector3f& point_world, const PosedCamera& last_camera,
               const Raster<float>& last_mm, float band_mm) {
  const Eigen::Vector3f left = last_camera.toLeft(point_world);
  int u0, v0;
  if (!last_camera.findPixel(left, &u0, &v0)) return false;
  for (int v = v0 - 1; v <= v0 + 1; ++v)
    for (int u = u0 - 1; u <= u0 + 1; ++u)
      if (last_mm.contains(u, v) && std::abs(last_mm.at(u, v) - left.z()) < band_mm) return true;
  return false;
}

/// Those that are allowed, in the image's order.
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

/// The pixels that become points, in the image's order: (F16), the first of every cell.
std::vector<std::int32_t> choosePixels(const Raster<float>& unexplained_mm,
                                       const PosedCamera& camera,
                                       const std::vector<std::uint8_t>& allowed,
                                       const InsertionOptions& options) {
  const std::vector<std::int32_t> candidates = candidatePixels(unexplained_mm, allowed);
  const float spacing_mm = static_cast<float>(options.spacing_mm);
  const float band_mm = static_cast<float>(options.band_mm);
  std::vector<CellKey> keys(candidates.size());
  parallelRanges(static_cast<int>(candidates.size()), kPointsATask, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const std::int32_t i = candidates[k];
      const Eigen::Vector3f ray =
          camera.ray(i % unexplained_mm.width_px, i / unexplained_mm.width_px);
      const float depth_mm = unexplained_mm.values[i];
      const float side_mm = spacingAt(depth_mm, camera.fx_px, spacing_mm);
      keys[k] = cellKey(ray * depth_mm, {side_mm, side_mm, band_mm});
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

void addPoint(std::int32_t pixel, const Observation& observation, const PosedCamera& camera,
              const ColourGain& gain, const FusionOptions& options, PointModel* model) {
  const std::size_t i = static_cast<std::size_t>(pixel);
  const Eigen::Vector3f left = camera.ray(pixel % camera.width_px, pixel / camera.width_px) *
                               observation.depth.depth_mm.values[i];
  const Eigen::Vector3f& normal = observation.normals.values[i];
  const Rgb8 colour =
      observation.colour.empty() ? Rgb8{} : modelColour(observation.colour.values[i], gain);
  const float weight = observation.depth.sigma_mm.empty()
                           ? 1.0f
                           : depthWeight(observation.depth.sigma_mm.values[i],
                                         static_cast<float>(options.points.reference_sigma_mm),
                                         static_cast<float>(options.points.max_measurement_weight));
  model->add(camera.toWorld(left), camera.left_from_world.transpose() * normal, colour,
             std::min(weight, static_cast<float>(options.points.max_weight)));
}

/// Makes room by a quarter more at a time: doubling would waste too much on a large model.
void makeRoom(std::size_t more, PointModel* model) {
  const std::size_t needed = model->size() + more;
  if (needed > model->positions_mm.capacity())
    model->reserve(std::max(needed, model->size() + model->size() / 4));
}

/// Which unexplained pixels may become points now.
std::vector<std::uint8_t> allowedPixels(const Raster<float>& unexplained_mm,
                                        const PosedCamera& camera, const InsertionMemory& last,
                                        bool at_once, float band_mm) {
  const PosedCamera last_camera = posedCamera(last.left, last.world_from_left);
  std::vector<std::uint8_t> allowed(unexplained_mm.size(), 0);
  parallelRows(unexplained_mm.height_px, [&](int v) {
    for (int u = 0; u < unexplained_mm.width_px; ++u) {
      const float depth_mm = unexplained_mm.at(u, v);
      if (!(depth_mm > 0)) continue;
      allowed[static_cast<std::size_t>(v) * unexplained_mm.width_px + u] =
          at_once || confirmed(camera.toWorld(camera.ray(u, v) * depth_mm), last_camera,
                               last.unexplained_mm, band_mm);
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
  const PosedCamera camera = posedCamera(observation.left, observation.world_from_left);
  const NearestSurface drawn = drawModel(*model, visibility, camera);
  Raster<float> unexplained_mm =
      UnexplainedDepths(observation, states, drawn, camera, options.insertion).find();
  const bool at_once = !options.insertion.confirm || model->empty();
  const std::vector<std::uint8_t> allowed = allowedPixels(
      unexplained_mm, camera, *memory, at_once, static_cast<float>(options.insertion.band_mm));
  const std::vector<std::int32_t> chosen =
      choosePixels(unexplained_mm, camera, allowed, options.insertion);
  makeRoom(chosen.size(), model);
  for (const std::int32_t pixel : chosen)
    addPoint(pixel, observation, camera, gain, options, model);
  InsertionSummary summary;
  summary.inserted = static_cast<int>(chosen.size());
  summary.unexplained_px = countAboveZero(unexplained_mm);
  *memory = {std::move(unexplained_mm), observation.left, observation.world_from_left};
  return summary;
}

}  // namespace softscope
