#include "toolkit/run/overlay_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "io/text/message.h"
#include "stereo/rectification/image_border.h"

namespace softscope {
namespace {

constexpr int kCellPx = 40;
constexpr double kLeastMotionPx = 5;  // between two images: more than a blurred edge is wide
constexpr int kFewestImages = 8;
constexpr float kLeastEdge = 8;         // grey levels per pixel: what matching finds in noise
constexpr float kLeastRatio = 1;        // of the gradient to the standard deviation, per pixel
constexpr double kBesideShare = 0.005;  // of the width: compression blurs edges
constexpr double kHarmlessShare = 0.002;

int radiusPx(int width_px) {
  return std::max(2, static_cast<int>(std::lround(kBesideShare * width_px)));
}

/// How far the tissue in the middle of a cell has moved in the image. Infinite where it has left.
double motionPx(const PinholeCamera& camera, const Eigen::Isometry3d& now_from_then,
                const Eigen::Vector2d& pixel, double depth_mm) {
  const Eigen::Vector3d there = now_from_then * liftPixel(camera, pixel.x(), pixel.y(), depth_mm);
  if (!(there.z() > 0)) return std::numeric_limits<double>::infinity();
  return (projectPoint(camera, there) - pixel).norm();
}

}  // namespace

std::vector<char> OverlayFinder::cellsThatMoved(const PinholeCamera& camera,
                                                const Eigen::Isometry3d& world_from_left,
                                                double depth_mm) {
  std::vector<char> moved(cells_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const int column = static_cast<int>(c) % columns_, row = static_cast<int>(c) / columns_;
    const Eigen::Vector2d middle((column + 0.5) * kCellPx, (row + 0.5) * kCellPx);
    if (cell.images > 0 && !(motionPx(camera, world_from_left.inverse() * cell.world_from_left,
                                      middle, cell.depth_mm) >= kLeastMotionPx))
      continue;
    cell = {world_from_left, depth_mm, cell.images + 1};
    moved[c] = 1;
  }
  return moved;
}

void OverlayFinder::ignore(const Mask& mask) {
  if (mask.values.size() != ignored_.values.size()) return;
  for (std::size_t i = 0; i < ignored_.values.size(); ++i)
    ignored_.values[i] |= static_cast<std::uint8_t>(mask.values[i] != 0);
}

void OverlayFinder::add(const ColourImage& left, const Mask& mask, const PinholeCamera& camera,
                        const Eigen::Isometry3d& world_from_left, double depth_mm) {
  if (left.empty() || !(depth_mm > 0)) return;
  if (mean_.empty()) {
    columns_ = (left.width_px + kCellPx - 1) / kCellPx;
    const int rows = (left.height_px + kCellPx - 1) / kCellPx;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
    mean_ = squares_ = Raster<float>(left.width_px, left.height_px, 0);
    ignored_ = Mask(left.width_px, left.height_px, 0);
    ignore(findBorder(left));
  }
  if (left.width_px != mean_.width_px || left.height_px != mean_.height_px) return;
  const std::vector<char> moved = cellsThatMoved(camera, world_from_left, depth_mm);
  if (std::find(moved.begin(), moved.end(), 1) == moved.end()) return;
  ignore(mask);
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) {
      const std::size_t c = static_cast<std::size_t>(v / kCellPx * columns_ + u / kCellPx);
      if (moved[c] == 0) continue;
      const float level = toGray(left.at(u, v)), off = level - mean_.at(u, v);
      mean_.at(u, v) += off / static_cast<float>(cells_[c].images);
      squares_.at(u, v) += off * (level - mean_.at(u, v));
    }
  });
}

Mask OverlayFinder::found() const {
  if (mean_.empty()) return {};
  const int radius_px = radiusPx(mean_.width_px);
  const Mask ignored = dilated(ignored_, 2 * radius_px);  // their edges stand still as well
  Mask fixed(mean_.width_px, mean_.height_px, 0);
  for (int v = 1; v + 1 < mean_.height_px; ++v)
    for (int u = 1; u + 1 < mean_.width_px; ++u) {
      const int images =
          cells_[static_cast<std::size_t>(v / kCellPx * columns_ + u / kCellPx)].images;
      if (images < kFewestImages || ignored.at(u, v) != 0) continue;
      const float across = (mean_.at(u + 1, v) - mean_.at(u - 1, v)) / 2,
                  down = (mean_.at(u, v + 1) - mean_.at(u, v - 1)) / 2,
                  edge = std::hypot(across, down);
      const float deviation = std::sqrt(squares_.at(u, v) / static_cast<float>(images - 1));
      fixed.at(u, v) = edge >= kLeastEdge && edge >= kLeastRatio * deviation;
    }
  Mask around = eroded(dilated(fixed, 3 * radius_px), 2 * radius_px);  // fills letters
  for (std::uint8_t& pixel : around.values) pixel = pixel != 0 ? 255 : 0;
  return around;
}

std::string overlayWarning(const Mask& found, const std::string& file) {
  const auto pixels = std::count(found.values.begin(), found.values.end(), 255);
  const double share =
      found.empty() ? 0 : static_cast<double>(pixels) / static_cast<double>(found.values.size());
  if (share < kHarmlessShare) return "";
  return say(
      std::round(1000 * share) / 10,
      " % of the left image stand still while the scope moves: text or icons drawn into it, "
      "dirt on the lens, or an instrument that moves with it. They are measured as a surface "
      "at a wrong distance; ",
      file, " marks them, for --mask of another run");
}

}  // namespace softscope
