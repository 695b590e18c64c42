#include "fusion/back_projection_error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/parallel.h"
#include "fusion/nearest_surface.h"
#include "fusion/sight.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

constexpr int kCellPx = 4;    // squares in which nearer points hide others …
constexpr float kHideMm = 1;  // … this far behind
constexpr std::uint64_t kNobody = ~std::uint64_t{0};

/// Depth above, index below: the smallest is the nearest point, the first of equals.
std::uint64_t entry(float depth_mm, int index) {
  std::uint32_t bits;
  std::memcpy(&bits, &depth_mm, sizeof bits);
  return std::uint64_t{bits} << 32 | static_cast<std::uint32_t>(index);
}

class Drawing {
 public:
  Drawing(const PointModel& model, const PosedCamera& camera)
      : model_(model),
        camera_(camera),
        surface_(camera.width_px, camera.height_px, kCellPx),
        nearest_(static_cast<std::size_t>(camera.width_px) * camera.height_px) {
    for (auto& pixel : nearest_) pixel.store(kNobody, std::memory_order_relaxed);
    parallelRanges(static_cast<int>(model.size()), kPointsATask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) draw(i);
    });
  }

  /// The point that pixel (u, v) shows; below 0 where there is none.
  int pointAt(int u, int v) const {
    const std::uint64_t held = nearest_[static_cast<std::size_t>(v) * camera_.width_px + u].load(
        std::memory_order_relaxed);
    if (held == kNobody) return -1;
    const int index = static_cast<int>(held & 0xFFFFFFFFu);
    const Eigen::Vector3f left = camera_.toLeft(model_.positions_mm[index]);
    const float cosine = -(camera_.left_from_world * model_.normals[index]).dot(left) / left.norm();
    const bool hidden = surface_.hides(u, v, left.z(), cosine, camera_.fx_px, kHideMm);
    return hidden ? -1 : index;
  }

 private:
  void draw(int i) {
    const Eigen::Vector3f left = camera_.toLeft(model_.positions_mm[i]);
    int u, v;
    if (!left.allFinite() || !camera_.findPixel(left, &u, &v)) return;
    surface_.add(u, v, left.z());
    const std::uint64_t mine = entry(left.z(), i);
    auto& pixel = nearest_[static_cast<std::size_t>(v) * camera_.width_px + u];
    std::uint64_t held = pixel.load(std::memory_order_relaxed);
    while (mine < held && !pixel.compare_exchange_weak(held, mine, std::memory_order_relaxed))
      ;
  }

  const PointModel& model_;
  const PosedCamera& camera_;
  NearestSurface surface_;
  std::vector<std::atomic<std::uint64_t>> nearest_;
};

BackProjectionError summarise(std::vector<float> differences_mm) {
  BackProjectionError error;
  error.compared_px = static_cast<int>(differences_mm.size());
  if (differences_mm.empty()) return error;
  double sum = 0, absolute_sum = 0;
  for (float& difference : differences_mm) {
    sum += difference;
    difference = std::abs(difference);
    absolute_sum += difference;
  }
  const std::size_t rank = (differences_mm.size() - 1) * 95 / 100;
  std::nth_element(differences_mm.begin(), differences_mm.begin() + rank, differences_mm.end());
  error.mean_mm = absolute_sum / error.compared_px;
  error.bias_mm = sum / error.compared_px;
  error.p95_mm = differences_mm[rank];
  return error;
}

}  // namespace

BackProjectionError backProjectionError(const PointModel& model, const Observation& observation,
                                        const Raster<PixelState>& states) {
  observation.validate();
  requireStates(states, observation);
  const PosedCamera camera = posedCamera(observation.left, observation.world_from_left);
  const Drawing drawing(model, camera);
  std::vector<float> differences_mm;
  for (int v = 0; v < states.height_px; ++v)
    for (int u = 0; u < states.width_px; ++u) {
      if (states.at(u, v) != PixelState::kSure) continue;
      const int index = drawing.pointAt(u, v);
      if (index < 0) continue;
      const Eigen::Vector3f left = camera.toLeft(model.positions_mm[index]);
      const Eigen::Vector3f lifted = camera.ray(u, v) * observation.depth.depth_mm.at(u, v);
      const float measured_mm = measuredDepth(left, lifted, observation.normals.at(u, v));
      if (std::isfinite(measured_mm)) differences_mm.push_back(left.z() - measured_mm);
    }
  return summarise(std::move(differences_mm));
}

}  // namespace softscope
