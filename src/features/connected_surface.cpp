#include "features/connected_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "features/nearest_depth.h"

namespace softscope {
namespace {

constexpr double kSigmas = 2;  // of depth, that are no step

/// Flood fill from the middle of a square of pixels.
class Flood {
 public:
  Flood(const DepthMap& depth, double focal_px, int u0, int v0, int side)
      : depth_(depth),
        focal_px_(focal_px),
        u0_(u0),
        v0_(v0),
        side_(side),
        reached_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0) {}

  std::vector<std::uint8_t> from(int u, int v) {
    mark(u, v);
    while (!open_.empty()) {
      const Eigen::Vector2i at = open_.back();
      open_.pop_back();
      for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                          Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)})
        visit(at, at + step);
    }
    return std::move(reached_);
  }

 private:
  void visit(const Eigen::Vector2i& from, const Eigen::Vector2i& to) {
    const int x = to.x() - u0_, y = to.y() - v0_;
    if (x < 0 || y < 0 || x >= side_ || y >= side_) return;
    if (!depth_.depth_mm.contains(to.x(), to.y()) || reached_[indexOf(x, y)] != 0) return;
    if (isSmooth(from, to)) mark(to.x(), to.y());
  }
  /// False without depth.
  bool isSmooth(const Eigen::Vector2i& from, const Eigen::Vector2i& to) const {
    const double from_mm = depth_.depth_mm.at(from.x(), from.y());
    const double to_mm = depth_.depth_mm.at(to.x(), to.y());
    const double sigma_mm =
        depth_.sigma_mm.empty()
            ? 0
            : std::max(depth_.sigma_mm.at(from.x(), from.y()), depth_.sigma_mm.at(to.x(), to.y()));
    return std::abs(to_mm - from_mm) <=
           kSteepest * std::min(to_mm, from_mm) / focal_px_ + kSigmas * sigma_mm;
  }
  void mark(int u, int v) {
    reached_[indexOf(u - u0_, v - v0_)] = 1;
    open_.emplace_back(u, v);
  }
  std::size_t indexOf(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }

  const DepthMap& depth_;
  double focal_px_;
  int u0_, v0_, side_;
  std::vector<std::uint8_t> reached_;
  std::vector<Eigen::Vector2i> open_;
};

}  // namespace

ConnectedSurface::ConnectedSurface(const DepthMap& depth, const Eigen::Vector2d& pixel,
                                   double focal_px, int reach_px) {
  if (!pixel.allFinite() || !(pixel.cwiseAbs().maxCoeff() < 1e6)) return;
  const NearestDepth nearest = nearestDepth(depth.depth_mm, pixel, gapPx(depth.depth_mm.width_px));
  if (!nearest.found()) return;
  const Eigen::Vector2i start = (pixel + nearest.away_px).array().round().cast<int>();
  side_ = 2 * reach_px + 1;
  u0_ = start.x() - reach_px;
  v0_ = start.y() - reach_px;
  const std::vector<std::uint8_t> reached =
      Flood(depth, focal_px, u0_, v0_, side_).from(start.x(), start.y());
  const std::size_t side = static_cast<std::size_t>(side_), stride = side + 1;
  sums_.assign(stride * stride, 0);
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x)
      sums_[(y + 1) * stride + x + 1] = reached[y * side + x] + sums_[y * stride + x + 1] +
                                        sums_[(y + 1) * stride + x] - sums_[y * stride + x];
}

bool ConnectedSurface::holds(const Eigen::Vector2d& pixel, int margin_px) const {
  const int x0 = static_cast<int>(std::lround(pixel.x())) - u0_ - margin_px;
  const int y0 = static_cast<int>(std::lround(pixel.y())) - v0_ - margin_px;
  const int x1 = x0 + 2 * margin_px + 1, y1 = y0 + 2 * margin_px + 1;
  if (x0 < 0 || y0 < 0 || x1 > side_ || y1 > side_) return false;
  const auto sum = [&](int x, int y) {
    return sums_[static_cast<std::size_t>(y * (side_ + 1) + x)];
  };
  return sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0) == (x1 - x0) * (y1 - y0);
}

}  // namespace softscope
