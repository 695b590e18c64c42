#include "fusion/drawn_points.h"

#include <cstring>

#include "core/parallel.h"

namespace softscope {
namespace {

std::uint64_t entryOf(float depth_mm, int index) {
  std::uint32_t bits;
  std::memcpy(&bits, &depth_mm, sizeof bits);
  return DrawnPoints::entry(bits, index);
}

}  // namespace

DrawnPoints::DrawnPoints(const PointModel& model, const PosedCamera& camera)
    : model_(model),
      camera_(camera),
      surface_(camera.width_px, camera.height_px, kCellPx),
      nearest_(static_cast<std::size_t>(camera.width_px) * camera.height_px),
      shown_(camera.width_px, camera.height_px) {
  parallelRows(camera.height_px, [&](int v) {
    auto* row = nearest_.data() + static_cast<std::size_t>(v) * camera.width_px;
    for (int u = 0; u < camera.width_px; ++u) row[u].store(kNoPoint, std::memory_order_relaxed);
  });
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) draw(i);
  });
  parallelRows(camera.height_px, [&](int v) {
    for (int u = 0; u < camera.width_px; ++u) shown_.at(u, v) = findShown(u, v);
  });
}

std::int32_t DrawnPoints::findShown(int u, int v) const {
  const std::uint64_t held =
      nearest_[static_cast<std::size_t>(v) * camera_.width_px + u].load(std::memory_order_relaxed);
  if (held == kNoPoint) return -1;
  const std::int32_t index = pointOf(held);
  const Eigen::Vector3f left = camera_.toLeft(model_.positions_mm[index]);
  if (!surface_.mayHide(u, v, left.z(), kHideMm)) return index;
  const float cosine = cosineToRay(left, camera_.left_from_world * model_.normals[index]);
  const bool hidden = surface_.hides(u, v, left.z(), cosine, camera_.fx_px, kHideMm);
  return hidden ? -1 : index;
}

void DrawnPoints::draw(int i) {
  const Eigen::Vector3f left = camera_.toLeft(model_.positions_mm[i]);
  int u, v;
  if (!left.allFinite() || !camera_.findPixel(left, &u, &v)) return;
  surface_.add(u, v, left.z());
  const std::uint64_t mine = entryOf(left.z(), i);
  auto& pixel = nearest_[static_cast<std::size_t>(v) * camera_.width_px + u];
  std::uint64_t held = pixel.load(std::memory_order_relaxed);
  while (mine < held && !pixel.compare_exchange_weak(held, mine, std::memory_order_relaxed))
    ;
}

}  // namespace softscope
